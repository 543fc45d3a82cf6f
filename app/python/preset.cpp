#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/files.h"
#include "app/python/bindings.h"
#include "core/io/preset_io.h"
#include "core/model/fields.h"

namespace tyglab::python {
namespace {

/// As `--set` takes it: words as they are, everything else as JSON, NumPy's numbers and arrays too.
std::string text_of(const py::handle& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  const auto plain = py::cpp_function([](const py::object& other) { return other.attr("tolist")(); });
  return py::module_::import("json").attr("dumps")(value, py::arg("default") = plain).cast<std::string>();
}

Preset with_constant(const Preset& preset, const std::string& key, const py::handle& value) {
  const std::string text = text_of(value);
  return with_parsed_settings(preset, {{key + "=" + text, key, text}});
}

py::dict as_dict(const Preset& preset) {
  return py::module_::import("json").attr("loads")(preset_to_json(preset));
}

/// In whichever block of the file it stands.
py::object constant(const Preset& preset, const std::string& key) {
  const py::dict all = as_dict(preset);
  if (all.contains(key)) return all[key.c_str()];
  if (const PresetRow* row = find_row(key); row != nullptr && all.contains(py::str(std::string(row->section)))) {
    const py::dict block = all[py::str(std::string(row->section))];
    const py::str inner(std::string(row->key_in_section()));
    if (block.contains(inner)) return block[inner];
  }
  for (const auto& [name, block] : all)
    if (py::isinstance<py::dict>(block) && block.contains(key)) return block[key.c_str()];
  // One that is left out is as that one.
  if (const PresetRow* row = find_row(key); row != nullptr && !row->otherwise.empty())
    return py::str(std::string(row->otherwise));
  throw py::key_error(key);
}

std::vector<std::string> keys() {
  std::vector<std::string> all;
  for (const PresetField& field : preset_fields()) all.emplace_back(field.key);
  return all;
}

Preset from_json(const std::string& text) {
  return parse_preset(text, "the text");
}

std::string described(const Preset& preset) {
  return "<tyglab.Preset \"" + preset.name + "\", " + std::to_string(preset.rows) + " x " +
         std::to_string(preset.columns) + ", " + preset.integrator + ">";
}

}  // namespace

Preset with_constants(const Preset& preset, const py::dict& constants) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : constants) {
    const auto key = name.cast<std::string>();
    const std::string text = text_of(value);
    settings.push_back({key + "=" + text, key, text});
  }
  return with_parsed_settings(preset, settings);
}

void add_preset(py::module_& module) {
  module.def("presets", &shipped_presets, "Names of the shipped presets.");
  py::class_<Preset> type(module, "Preset",
                          "A scene: all of its constants, under the keys of the notation table (docs/notation.md) "
                          "and of --set. Preset() is the default cloth; Preset(k_s=200, integrator=\"rk4\") changes "
                          "two constants. A wrong key or value raises PresetError and changes nothing.");
  refuse_objects_without_value(type);
  type.def(py::init([](const py::kwargs& constants) { return with_constants({}, constants); }))
      .def_static(
          "load", [](const std::string& name) { return read_preset(find_preset(name).file); }, py::arg("name"),
          "Reads a shipped preset by its name (presets()), or else a preset file.")
      .def_static("from_json", &from_json, py::arg("text"), "Parses the text of a preset file.")
      .def("to_json", &preset_to_json, "The preset as the text of a preset file.")
      .def(
          "save", [](const Preset& preset, const std::filesystem::path& file) { write_preset(preset, file); },
          py::arg("file"),
          "Writes a preset file. An older file is replaced only when the new one is complete. Raises OSError.")
      .def_static("keys", &keys, "The keys of all constants.")
      .def("to_dict", &as_dict, "A copy of all constants, in the blocks of a preset file.")
      .def("__getitem__", &constant)
      .def("__setitem__", [](Preset& preset, const std::string& key,
                             const py::object& value) { preset = with_constant(preset, key, value); })
      .def(
          "but", [](const Preset& preset, const py::kwargs& constants) { return with_constants(preset, constants); },
          "A copy with some constants changed: preset.but(dt=0.0005).")
      .def(
          "__eq__", [](const Preset& a, const Preset& b) { return a == b; }, py::is_operator())
      .def("__repr__", &described)
      .def(py::pickle([](const Preset& preset) { return preset_to_json(preset); }, &from_json));
}

}  // namespace tyglab::python

#include "app/ui/constants/constants_panel.h"

#include <algorithm>
#include <array>

#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

/// The plain engine computes in double, whatever the preset's precision.
bool is_mode_of(const EngineMode& mode, const Preset& preset) {
  return mode.engine == preset.engine && (mode.precision == preset.precision || mode.engine == EngineKind::plain);
}

constexpr double looks_again = 0.1;  // s, until the devices are known

/// The device that a preset runs on; null where there is none, or none is known.
const OpenClDevice* device_of(const Preset& preset, const OpenClInventory* devices) {
  if (devices == nullptr) return nullptr;
  const std::vector<OpenClDevice>& all = devices->devices;
  const int number = preset.device >= 0 ? preset.device : preferred_device(all);
  return number < int(all.size()) ? &all[std::size_t(number)] : nullptr;
}

void mode_choices(Ui& ui, const OpenClInventory* devices) {
  const Preset& preset = ui.session.requested_preset();
  for (const EngineMode& mode : engine_modes()) {
    const bool now = is_mode_of(mode, preset);
    const std::string obstacle = now ? "" : why_not(mode, preset, devices);
    const ImGuiSelectableFlags flags = obstacle.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(mode.label, now, flags) && !now) {
      Preset next = preset;
      next.engine = mode.engine, next.precision = mode.precision;
      ui.session.propose(std::move(next));
    }
    report_control(ui, mode.name);
    tooltip(ui, gui::item_id(), obstacle.empty() ? words_of(mode, preset, devices) : obstacle);
  }
}

/// Where there are several, while one of them is in use.
void device_choices(Ui& ui, const OpenClInventory& inventory) {
  if (inventory.devices.size() < 2) return;
  ImGui::Separator();
  for (int n = 0; n < int(inventory.devices.size()); ++n) {
    const OpenClDevice& device = inventory.devices[std::size_t(n)];
    ImGui::PushID(n);
    if (ImGui::Selectable(device.name.c_str(), ui.session.requested_preset().device == n)) {
      Preset next = ui.session.requested_preset();
      next.device = n;
      ui.session.propose(std::move(next));
    }
    ImGui::PopID();
    report_control(ui, "device_" + std::to_string(n));
    tooltip(ui, gui::item_id(),
            "OpenCL device " + std::to_string(n) + ": " + device.name + " of " + device.platform + ", " +
                std::to_string(device.compute_units) + " compute units.");
  }
}

}  // namespace

std::span<const EngineMode> engine_modes() {
  static constexpr std::array<EngineMode, 5> modes{
      {{"cpu_float", "CPU · float", "CPU, float", EngineKind::cpu, Precision::float_},
       {"cpu_double", "CPU · double", "CPU, double", EngineKind::cpu, Precision::double_},
       {"opencl_float", "OpenCL · float", "OpenCL, float", EngineKind::opencl, Precision::float_},
       {"opencl_double", "OpenCL · double", "OpenCL, double", EngineKind::opencl, Precision::double_},
       {"plain", "plain · double", "plain, double", EngineKind::plain, Precision::double_}}};
  return modes;
}

std::string why_not(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices) {
  if (mode.engine == EngineKind::cpu) return {};
  if (mode.engine == EngineKind::plain)
    return is_written_out(scheme(preset.integrator)) ? "" : "The plain engine runs explicit methods of fixed dt only.";
  if (devices != nullptr && devices->devices.empty()) return no_device_words(devices->problem);
  const Scheme& method = scheme(preset.integrator);
  if (!runs_on_opencl(method))
    return std::string(method.title) + " runs only on the CPU engine. Choose another method first.";
  if (const Force* force = missing_on_opencl(preset))
    return words_of_missing(*force, method.title) + " runs only on the CPU engine." +
           (force == &force::air ? " Choose an explicit method first." : "");
  const OpenClDevice* device = device_of(preset, devices);
  if (device != nullptr && mode.precision == Precision::double_ && !device->fp64)
    return device->name + " does not support double precision.";
  return {};
}

std::string words_of(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices) {
  if (mode.engine == EngineKind::plain)
    return "Loops over particles as a student would write them, in double: the reference of the others, about 60 times "
           "slower than the CPU engine.";
  std::string where = "On the CPU";
  if (mode.engine == EngineKind::opencl) {
    const OpenClDevice* device = device_of(preset, devices);
    where = device != nullptr ? "With OpenCL on " + device->name : "With OpenCL, on a GPU or another device";
  }
  return where + (mode.precision == Precision::float_ ? ", in float: 7 significant digits."
                                                      : ", in double: 16 significant digits, and twice the memory.");
}

void engine_menu(Ui& ui, float width) {
  const Preset& preset = ui.session.requested_preset();
  const auto modes = engine_modes();
  const auto now =
      std::find_if(modes.begin(), modes.end(), [&](const EngineMode& mode) { return is_mode_of(mode, preset); });
  if (!begin_combo(ui, "##engine", now->label, width)) {
    tooltip(ui, gui::item_id(), "Engine and precision. Now: " + ui.session.simulation->engine().name());
    return;
  }
  ui.session.studies.devices.begin();
  const OpenClInventory* devices = ui.session.studies.devices.found();
  if (devices == nullptr) ui.draw_by = std::min(ui.draw_by, ui.now + looks_again);
  mode_choices(ui, devices);
  if (ImGui::Selectable("Automatic")) ui.command("choose_engine");
  report_control(ui, "automatic_engine");
  tooltip(ui, gui::item_id(), "Chooses the fastest engine for this scene and precision by short trial runs.");
  if (preset.engine == EngineKind::opencl && devices != nullptr) device_choices(ui, *devices);
  end_combo();
}

}  // namespace tyglab

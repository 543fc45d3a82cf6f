#include "app/session/document.h"

#include <cassert>

#include "app/base/experiment_file.h"
#include "app/base/files.h"
#include "app/base/settings.h"
#include "app/base/text.h"
#include "app/platform/platform.h"
#include "app/session/session.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

Preset on_cpu(Preset preset) {
  preset.engine = EngineKind::cpu;
  return preset;
}

/// The middle of the cloth, so that there is something to read at once.
std::optional<Pins::Site> first_pick(const Session& session) {
  const Lattice lattice = session.simulation->lattice().sites();
  return Pins::Site{lattice.rows / 2, lattice.columns / 2};
}

}  // namespace

void begin_document(Session& session, Document document) {
  assert(session.simulation != nullptr);
  session.document = std::move(document);
  if (session.show_texture)
    if (const auto problem = session.show_texture(session.preset().texture)) session.messages.error(*problem);
  session.repetition.reset();
  session.history.clear(), session.rewind.clear(), session.timeline.clear(), session.curves.clear(),
      session.auto_dt.reset();
  session.picked = first_pick(session);
  session.recorded.clear();
  session.pacing.forget_cost(), session.pacing.restart_measure();
  ++session.counts.documents;
  if (auto experiment = std::exchange(session.document.experiment, nullptr))
    begin_repetition(session, std::move(experiment));
}

std::unique_ptr<Simulation> make_simulation(const Preset& preset, int threads, std::string& fallback) {
  try {
    return std::make_unique<Simulation>(preset, threads);
  } catch (const EngineError& error) {
    if (preset.engine == EngineKind::cpu) throw;
    fallback = sentence(error.what()) + " The CPU engine runs it instead.";
    return std::make_unique<Simulation>(on_cpu(preset), threads);
  }
}

void take_built(Session& session, std::unique_ptr<Simulation> simulation, BuildOrder order) {
  assert(simulation != nullptr && !order.programs);
  settle(session);
  const Preset before = session.preset();
  if (order.fresh && !order.document) simulation->continue_recording(*session.simulation);
  swap_in(session, std::move(simulation));
  if (order.document) return begin_document(session, std::move(*order.document));
  follow_up(session, before, changes(before, session.preset()));
  if (!order.fresh) return;
  session.recorded.clear();
  session.pacing.restart_measure();
}

void reopen_document(Session& session, const Preset& preset, const Document& document) {
  BuildOrder order{.target = preset, .document = document};
  if (takes_long(session, preset)) return session.rebuild.order(session, std::move(order), session.history);
  std::string fallback;
  auto simulation = make_simulation(preset, session.threads, fallback);
  if (!fallback.empty()) session.messages.warning(fallback);
  session.rebuild.drop();
  take_built(session, std::move(simulation), std::move(order));
}

void open_document(Session& session, const std::filesystem::path& file, bool shipped,
                   const std::vector<std::string>& settings) {
  try {
    if (is_experiment(file)) {
      const auto experiment = std::make_shared<const Experiment>(load_experiment(file));
      const Preset& start = experiment->recording.start();
      return reopen_document(session, start, {start, file.stem().string(), {}, experiment});
    }
    const Preset preset = with_settings(read_preset(file), settings);
    reopen_document(session, preset, {preset, file.stem().string(), shipped ? std::filesystem::path() : file});
  } catch (const std::bad_alloc&) {
    session.messages.error("There is not enough memory for " + file.string() + ". The present cloth is kept.");
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
}

void open_link(Session& session, const std::string& link) {
  try {
    const LinkedPreset linked = read_link(link);
    linked_preset(linked);  // what is wrong with it is said of the link
    session.request(request::Open{.file = find_preset(linked.name).file, .shipped = true, .settings = linked.settings});
  } catch (const PresetError& error) {
    session.messages.error(error.what());
  }
}

bool save_document_as(Session& session, const std::filesystem::path& file, const std::string& name) {
  try {
    Preset preset = session.preset();
    // What the former preset says of itself need not hold of one that is called otherwise.
    const Preset& former = session.document.saved;
    if (name != former.name && preset.description == former.description)
      preset.description = "Based on “" + former.name + "”.";
    preset.name = name;
    if (const std::string wrong = check_preset(preset); !wrong.empty()) throw PresetError(wrong);
    if (is_experiment(file)) throw OutputError("NAME.tyglab is an experiment; name the preset NAME.json.");
    // The program's own folder is made where it is missing; nobody else's.
    std::error_code ignored;
    const std::filesystem::path folder = file.parent_path();
    if (folder == user_preset_folder()) std::filesystem::create_directories(folder, ignored);
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
      throw OutputError("The folder " + folder.string() + " does not exist; create it first, or choose another.");
    const std::string texture = preset.texture;
    preset = write_preset(preset, file);
    hand_out(file);
    std::string copied;
    if (preset.texture != texture)
      copied = " and its texture " + std::filesystem::path(preset.texture).filename().string();
    Document saved{preset, file.stem().string(), file};
    if (!session.copies.lockstep.empty()) copied += ". The copies are not saved: a preset contains one cloth.";
    std::string said = "Saved " + file.string() + copied, opened = saved.label;
    session.rebuild.rename(name, preset.description);
    if (!session.rebuild.holds_present()) apply_to_all(session, edit::Change{preset});
    if (session.labs.opened == session.document.label)
      session.labs.opened = std::move(opened);  // still the lab's cloth
    session.document = std::move(saved);
    session.messages.note(std::move(said));
    return true;
  } catch (const std::bad_alloc&) {
    session.not_saved = SaveProblem{file, name, "There is not enough memory to save it; close other programs."};
  } catch (const std::exception& error) {
    session.not_saved = SaveProblem{file, name, error.what()};
  }
  return false;
}

}  // namespace tyglab

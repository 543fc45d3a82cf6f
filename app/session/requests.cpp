#include "app/session/requests.h"

#include "app/base/files.h"
#include "app/base/text.h"
#include "app/session/document.h"
#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/model/effect.h"

namespace tyglab {
namespace {

/// Above this many particles a frame may take seconds, so the user is asked first.
constexpr double large_cloth = 1e6;

/// dt follows the other constants while it is automatic; who sets it by hand takes it over.
void follow_constants(Session& session, Preset& next) {
  if (!session.auto_dt) return;
  const auto dt = AutoStep::choose(next);
  if (next.dt != session.requested_preset().dt || !dt) {
    session.auto_dt.reset();
    session.messages.note(dt ? "dt is manual again." : next.integrator + " has no stable dt: dt is manual again.");
    return;
  }
  session.auto_dt->begin();
  // What is only seen changes no limit, and a halved dt stays.
  if (!changes(session.requested_preset(), next).within(appearance)) next.dt = *dt;
}

/// A method or a force that the present engine does not run brings the CPU engine with it. Returns what is to be said
/// of that.
std::string take_engine_along(const Session& session, Preset& next) {
  if (next.engine == EngineKind::cpu) return {};
  const Scheme& method = scheme(next.integrator);
  const bool opencl = next.engine == EngineKind::opencl,
             runs = opencl ? runs_on_opencl(method) : is_written_out(method);
  const Force* missing = opencl ? missing_on_opencl(next) : nullptr;
  if (missing == nullptr && (runs || next.integrator == session.requested_preset().integrator)) return {};
  next.engine = EngineKind::cpu;
  return (missing != nullptr && runs ? words_of_missing(*missing, method.title) : std::string(method.title)) +
         " runs only on the CPU engine, so that engine was chosen.";
}

void ask_about_changes(Session& session, Request then) {
  session.question = Question{Question::About::unsaved_changes,
                              "The changes to " + session.preset().name + " have not been saved.", std::move(then)};
}

void apply(Session& session, const request::Apply& what) {
  if (const auto* change = std::get_if<edit::Change>(&what.edit); change != nullptr && !what.confirmed) {
    const double count = particles(change->preset), now = particles(session.requested_preset());
    if (count > large_cloth && count > 1.001 * now) {
      request::Apply agreed = what;
      agreed.confirmed = true;
      const std::string size = std::to_string(change->preset.rows) + " × " + std::to_string(change->preset.columns);
      session.question = Question{Question::About::large_cloth,
                                  size + " is " + short_number(count / 1e6, 3) +
                                      " million particles. A frame may take seconds. Build it anyway?",
                                  std::move(agreed)};
      return;
    }
  }
  Edit edit = what.edit;
  std::string note;
  if (auto* change = std::get_if<edit::Change>(&edit)) {
    note = take_engine_along(session, change->preset);
    follow_constants(session, change->preset);
  }
  if (apply_edit(session, edit, what.gesture) && !note.empty()) session.messages.note(std::move(note));
  session.last_change = session.now;
}

void apply(Session& session, const request::Retry& what) {
  const bool back = rewind(session);
  if (take_back(session, what.preset) && !back) restart(session);
}

void apply(Session& session, const request::Replay&) {
  begin_replay(session);
}

void apply(Session& session, const request::Open& what) {
  if (!what.confirmed && unsaved(session)) {
    request::Open agreed = what;
    agreed.confirmed = true;
    return ask_about_changes(session, std::move(agreed));
  }
  open_document(session, what.file, what.shipped, what.settings);
}

bool apply(Session& session, const request::SavePreset& what) {
  return save_document_as(session, what.file, what.name);
}

void apply(Session& session, const request::LoadTexture& what) {
  Preset next = session.requested_preset();
  next.texture = chosen_texture(what.name);
  apply_edit(session, edit::Change{next});
}

void apply(Session& session, const request::AddCopy& what) {
  add_copy(session, what.differences, what.as_reference);
}

void apply(Session& session, const request::RemoveCopy& what) {
  remove_copy(session, what.index);
}

void apply(Session& session, const request::Quit& what) {
  if (!what.confirmed && !session.scripted && unsaved(session))
    return ask_about_changes(session, request::Quit{.confirmed = true});
  session.quit = true;
}

}  // namespace

bool unsaved(const Session& session) {
  if (no_work(session) || (session.repetition && session.repetition->experiment)) return false;
  // What is still being built would be lost as well.
  return !changes(session.document.saved, session.requested_preset()).within(Effect::view);
}

bool changed_since_divergence(const Session& session) {
  if (!session.simulation->divergence()) return false;
  return !same_model(session.simulation->diverged_preset(), session.preset());
}

bool same_model(const Preset& a, const Preset& b) {
  return changes(a, b).within(beside_model);
}

void apply_requests(Session& session) {
  // What these requests ask for in turn is applied in the next update.
  const std::vector<Request> requests = std::move(session.requests);
  session.requests.clear();
  for (const Request& request : requests) {
    // What was to follow a saving (another preset, the end) does not where the saving failed: nothing may be lost.
    if (const auto* save = std::get_if<request::SavePreset>(&request)) {
      if (!apply(session, *save)) return;
      continue;
    }
    std::visit([&](const auto& what) { apply(session, what); }, request);
  }
}

}  // namespace tyglab

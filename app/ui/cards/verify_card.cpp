// The card of the gallery of `tyglab verify`: cases with exact or published answers, measured here and now.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/ui/cards/cards.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/verify/gallery.h"

namespace tyglab {
namespace {

constexpr float verify_line_at_1 = 62, verify_mark_at_1 = 20, verify_picture_at_1 = 54;  // pixels at scale 1

/// "measured 0.3312 m, exact 0.3310 m", or that it has not been measured.
std::string value_words(const verify::Case& of, const VerifiedCase* one) {
  if (one == nullptr) return "not measured yet";
  const auto value = [&](double number) {
    return short_number(number, 5) + (of.unit.empty() ? "" : " " + std::string(of.unit));
  };
  return "measured " + value(one->measured) + ", exact " + value(one->exact);
}

/// "error 5.9e-4 (1e-3), order 2.00": with the largest allowed, which is all that is known before.
std::string error_words(const verify::Case& of, const VerifiedCase* one) {
  if (one == nullptr) return "error at most " + short_number(of.allowed, 2);
  return "error " + short_number(one->error, 2) + " (" + short_number(of.allowed, 2) + ")" +
         (one->order ? ", order " + short_number(*one->order, 3) : "");
}

void verify_tooltip(Ui& ui, const verify::Case& of, const VerifiedCase* one) {
  const Tokens& c = ui.theme.colors;
  begin_tooltip(ui);
  wrapped(ui, of.sentence, c.text);
  if (one != nullptr) wrapped(ui, sentence(value_words(of, one)), c.text);
  if (one != nullptr)
    wrapped(ui,
            "Error " + short_number(one->error, 2) + ", at most " + short_number(of.allowed, 2) + " is allowed" +
                (one->at.empty() ? "." : " (" + one->at + ")."),
            one->ok ? c.text : c.danger);
  wrapped(ui, "Source: " + std::string(of.source) + ".", c.quiet);
  end_tooltip(ui);
}

/// The rows and columns of a case's last motion, seen from the front and a little from the right and above.
void verify_picture(const Tokens& c, const VerifiedCase& one, ImVec2 lo, float side) {
  constexpr float yaw = 0.45f, pitch = 0.3f;
  std::vector<glm::vec2> seen;
  glm::vec2 least{std::numeric_limits<float>::infinity()}, most = -least;
  for (const glm::vec3& x : one.x) {
    const float depth = x.z * std::cos(yaw) + x.x * std::sin(yaw);
    seen.emplace_back(x.x * std::cos(yaw) - x.z * std::sin(yaw), depth * std::sin(pitch) - x.y * std::cos(pitch));
    least = glm::min(least, seen.back()), most = glm::max(most, seen.back());
  }
  const float size = std::max({most.x - least.x, most.y - least.y, 1e-9f});
  const glm::vec2 shift = (glm::vec2(side) - (most - least) * (side / size)) / 2.0f;
  const auto at = [&](int i, int j) {
    const glm::vec2 p = shift + (seen[std::size_t(i * one.columns + j)] - least) * (side / size);
    return ImVec2(lo.x + p.x, lo.y + p.y);
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int i = 0; i < one.rows; ++i)
    for (int j = 0; j < one.columns; ++j) {
      if (i > 0) draw.AddLine(at(i - 1, j), at(i, j), c.quiet);
      if (j > 0) draw.AddLine(at(i, j - 1), at(i, j), c.quiet);
    }
  if (one.rows * one.columns <= 2)
    for (std::size_t p = 0; p < seen.size(); ++p)
      draw.AddCircleFilled(at(int(p) / one.columns, int(p) % one.columns), 3, c.text);
}

void verify_line(Ui& ui, const verify::Case& of, const VerifiedCase* one, float width) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float height = ui.theme.px(verify_line_at_1), mark = ui.theme.px(verify_mark_at_1);
  ImGui::PushID(of.name.data());
  ImGui::Dummy({width, height});
  if (!ImGui::IsItemVisible()) return ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) {
    draw.AddRectFilled(lo, {lo.x + width, lo.y + height}, c.field, ui.theme.px(4));
    verify_tooltip(ui, of, one);
  }
  ImGui::PopID();
  const auto baseline = [&](float part) { return baseline_at(ui.fonts, lo.y + part * height); };
  if (one != nullptr)
    draw_on_baseline(draw, *ui.fonts.text, {lo.x + ui.theme.px(2), baseline(0.2f)}, one->ok ? c.good : c.danger,
                     one->ok ? icon_or(ui.fonts, icon::check, "+") : icon_or(ui.fonts, icon::close, "x"));
  float room = width - mark;
  if (const float side = ui.theme.px(verify_picture_at_1); one != nullptr && !one->x.empty() && room > 3 * side) {
    room -= side + ui.theme.px(8);
    verify_picture(c, *one, {lo.x + width - side, lo.y + (height - side) / 2}, side);
  }
  const auto write = [&](const ImFont& font, float part, ImU32 color, const std::string& text) {
    draw_on_baseline(draw, font, {lo.x + mark, baseline(part)}, color, fitted(font, text, room));
  };
  write(*ui.fonts.text, 0.2f, c.text, std::string(of.title));
  write(*ui.fonts.small, 0.5f, c.quiet, value_words(of, one));
  write(*ui.fonts.small, 0.77f, one != nullptr && !one->ok ? c.danger : c.quiet, error_words(of, one));
}

}  // namespace

std::string verify_words(const VerifyFindings& findings, bool running) {
  if (!findings.problem.empty()) return findings.problem;
  const auto good = std::count_if(findings.cases.begin(), findings.cases.end(), [](const auto& one) { return one.ok; });
  const std::string of = std::to_string(findings.cases.size()), all = std::to_string(verify::all_cases().size());
  if (findings.cases.empty() && running) return "Measuring the first of " + all + " cases.";
  const std::string held = std::to_string(good) + " of " + of + " hold";
  return findings.done ? held + "." : held + (running ? ", " : "; stopped after ") + of + " of " + all + " measured.";
}

void verification(Ui& ui, ImVec2 size) {
  VerifyWatch& watch = ui.session.studies.verification;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool running = watch.running();
  if (text_button(ui, running ? "Stop" : "Run", !running)) running ? watch.stop() : watch.ask();
  const auto findings = watch.findings();
  const std::string words = findings ? verify_words(*findings, running) : "Cases with exact or published answers.";
  ImGui::SetCursorScreenPos({lo.x, ImGui::GetCursorScreenPos().y});
  ImGui::PushFont(ui.fonts.small);
  wrapped(ui, in_lines(*ui.fonts.small, words, size.x), ui.theme.colors.text);
  ImGui::PopFont();
  const float used = ImGui::GetCursorScreenPos().y + ui.theme.px(4) - lo.y;
  ImGui::SetCursorScreenPos({lo.x, lo.y + used});
  gui::begin_child("verify cases", {size.x, std::max(size.y - used, 1.f)});
  const float width = ImGui::GetContentRegionAvail().x;
  for (const verify::Case* one : verify::all_cases()) {
    const VerifiedCase* known = nullptr;
    if (findings)
      for (const VerifiedCase& measured : findings->cases)
        if (measured.name == one->name) known = &measured;
    verify_line(ui, *one, known, width);
  }
  ImGui::EndChild();
}

}  // namespace tyglab

#include "app/tools/wind_arrow.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr float usual = 80, longest = 140, handle = 14, calm = 8;  // pixels at scale 1
constexpr float from_right = 132, from_below = 120;
constexpr double most = 1e3;                    // N, of a component
constexpr unsigned first_gesture = 0x77000000;  // apart from those of sliders and bodies

glm::dvec3 place(const App& app) {
  const glm::vec2 size = app.viewport.size(), away{app.theme.px(from_right), app.theme.px(from_below)};
  return app.camera.unproject_in_camera_plane(glm::max(size - away, size / 2.0f), glm::dvec3(app.camera.target), size);
}

/// N: what an arrow of the usual length stands for.
double unit_of(const App& app) {
  const Preset& saved = app.document.saved;
  if (const double W = glm::length(saved.W); W > 0) return W;
  const double weight = std::abs(saved.m * saved.g);
  return weight > 0 ? weight : 1e-3;
}

/// The nearest axis, if Ctrl asks for one.
glm::dvec3 snapped(const glm::dvec3& W) {
  const glm::dvec3 size = glm::abs(W);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  glm::dvec3 on_axis(0);
  on_axis[axis] = W[axis];
  return on_axis;
}

/// Components with so many digits as the largest needs for three.
glm::dvec3 tidy(const glm::dvec3& W) {
  const glm::dvec3 size = glm::abs(W);
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest > 0)) return glm::dvec3(0);
  const double digits = std::pow(10, 2 - std::floor(std::log10(largest)));
  return glm::clamp(glm::round(W * digits) / digits, -most, most);
}

}  // namespace

bool wind_arrow_shown(const App& app) {
  return app.preset().kind == Kind::cloth && app.ui.wind_arrow.value_or(app.requested_preset().W != glm::dvec3(0));
}

WindArrow wind_arrow(const App& app, const glm::dvec3& W) {
  const glm::dvec3 base = place(app);
  const double per_pixel = app.camera.metres_per_pixel(base, app.viewport.size().y);
  const double per_newton = app.theme.px(usual) * per_pixel / unit_of(app);
  const double length = glm::length(W) * per_newton, room = app.theme.px(longest) * per_pixel;
  return {base, base + W * per_newton * (length > room ? room / length : 1), per_newton};
}

bool on_wind_tip(const App& app, glm::vec2 at) {
  if (!wind_arrow_shown(app)) return false;
  const auto tip = app.camera.project(wind_arrow(app, app.requested_preset().W).tip, app.viewport.size());
  return tip && glm::distance(*tip, at) <= app.theme.px(handle);
}

void take_wind(App& app) {
  Tool& tool = app.tool;
  tool.kind = Tool::Kind::wind;
  tool.wind = app.requested_preset().W;
  tool.wind_gesture = std::max(tool.wind_gesture + 1, first_gesture);
  app.ui.wind_arrow = true;  // a wind that is dragged to nothing can be taken up again
}

void drag_wind(App& app) {
  const Tool& tool = app.tool;
  const WindArrow arrow = wind_arrow(app, tool.wind);
  const glm::vec2 size = app.viewport.size();
  glm::dvec3 way = app.camera.unproject_in_camera_plane(tool.at, arrow.tip, size) -
                   app.camera.unproject_in_camera_plane(tool.press, arrow.tip, size);
  const double per_pixel = app.camera.metres_per_pixel(arrow.base, size.y);
  if ((app.input.mods & GLFW_MOD_SHIFT) != 0)
    way = double(tool.press.y - tool.at.y) * per_pixel * glm::dvec3(app.camera.forward());
  glm::dvec3 W = tool.wind + way / arrow.metres_per_newton;
  if ((app.input.mods & GLFW_MOD_CONTROL) != 0) W = snapped(W);
  if (glm::length(W) * arrow.metres_per_newton < app.theme.px(calm) * per_pixel) W = glm::dvec3(0);
  Preset next = app.requested_preset();
  next.W = tool.at == tool.press ? tool.wind : tidy(W);
  if (next.W != app.requested_preset().W) app.propose(std::move(next), tool.wind_gesture);
}

}  // namespace tyglab

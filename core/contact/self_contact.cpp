#include "core/contact/self_contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace tyglab {
namespace {

constexpr double reach_per_L = 0.4;
constexpr double default_thickness_per_L = 0.15, largest_thickness_per_L = 0.19;  // d stays below the reach
constexpr double share_of_gap = 0.9, least_gap_per_L = 1e-4;                      // γ and δ/L
constexpr double slow = 0.01;  // m/s: friction grows up to about this speed

}  // namespace

double contact_thickness(const Preset& preset) {
  return preset.thickness > 0 ? preset.thickness : default_thickness_per_L * preset.L;
}

double largest_thickness(double L) {
  return largest_thickness_per_L * L;
}

void SelfContact::set_preset(const Preset& preset, double k) {
  L_ = preset.L, d_ = 2 * contact_thickness(preset);
  k_ = k, friction_ = preset.self_friction;
  assert(L_ > 0 && d_ > 0 && d_ < reach_per_L * L_);
  pairs_.set_distances(L_, reach_per_L * L_);
}

void SelfContact::follow(const Tears& tears, Vectors x) {
  pairs_.follow(tears, x);
  nearest_ = reach_per_L * L_;
}

void SelfContact::look(Vectors x, bool begins_step) {
  touches_.clear();
  double nearest = d_;
  pairs_.measure(d_, x, [&](const std::array<int, 4>& at, const Gap& gap, double distance) {
    nearest = std::min(nearest, distance);
    if (distance == 0) return;
    // There can be many: memory grows less than a vector's own way, and is given back.
    if (touches_.size() == touches_.capacity()) touches_.reserve(touches_.size() + touches_.size() / 4 + 16);
    touches_.push_back({at, gap.weights, gap.between / distance, d_ - distance});
  });
  if (touches_.capacity() > 2 * touches_.size() + 64) touches_.shrink_to_fit();
  if (begins_step) nearest_ = nearest;
}

void SelfContact::begin_solve(Vectors x) {
  touches_.clear(), sides_.clear();
  if (pairs_.near()) renew_solve(x);
}

void SelfContact::renew_solve(Vectors x) {
  const std::ptrdiff_t known = std::ssize(sides_);
  pairs_.measure(reach_per_L * L_, x, [&](const std::array<int, 4>& at, const Gap& gap, double distance) {
    if (distance > 0) sides_.push_back({at, gap.edges, gap.between / distance});
  });
  // Each pair stays once, with its first side.
  const auto name = [](const Side& side) { return std::tie(side.at, side.edges); };
  const auto before = [&](const Side& a, const Side& b) { return name(a) < name(b); };
  std::sort(sides_.begin() + known, sides_.end(), before);
  std::inplace_merge(sides_.begin(), sides_.begin() + known, sides_.end(), before);
  const auto same = [&](const Side& a, const Side& b) { return name(a) == name(b); };
  sides_.erase(std::unique(sides_.begin(), sides_.end(), same), sides_.end());
}

void SelfContact::look_in_solve(Vectors x) {
  touches_.clear();
  for (Side& side : sides_) {
    const auto place = [&](std::size_t n) { return x[std::size_t(side.at[n])]; };
    const Gap gap = side.edges ? gap_of_edges({place(0), place(1)}, {place(2), place(3)})
                               : gap_to_triangle(place(0), {place(1), place(2), place(3)});
    if (glm::dot(gap.between, side.normal) > 0) side.normal = glm::normalize(gap.between);
    const double distance = glm::dot(gap.between, side.normal);
    // What is beside the other part has gone around it.
    const bool beside = distance < 0 && glm::length(gap.between - distance * side.normal) > reach_per_L * L_;
    if (distance < d_ && !beside) touches_.push_back({side.at, gap.weights, side.normal, d_ - distance});
  }
}

double SelfContact::add_forces(std::span<glm::dvec3> F) const {
  const double k = k_ / (d_ * d_);
  double energy = 0;
  for (const Touch& touch : touches_) {
    energy += touch.push(k) * touch.s / 4;
    const glm::dvec3 force = touch.push(k) * touch.normal;
    for (std::size_t n = 0; n < touch.at.size(); ++n) F[std::size_t(touch.at[n])] += touch.weights[n] * force;
  }
  return energy;
}

/// How fast its parts slide over each other, m/s.
glm::dvec3 SelfContact::slip_of(const Touch& touch, Vectors v) const {
  glm::dvec3 slip{0};
  for (std::size_t n = 0; n < touch.at.size(); ++n) slip += touch.weights[n] * v[std::size_t(touch.at[n])];
  return slip - glm::dot(slip, touch.normal) * touch.normal;
}

/// Its friction by that, N s/m.
double SelfContact::friction_of(const Touch& touch, const glm::dvec3& slip) const {
  return friction_ * touch.push(k_ / (d_ * d_)) / std::sqrt(glm::dot(slip, slip) + slow * slow);
}

void SelfContact::add_friction(Vectors v, std::span<glm::dvec3> F) const {
  for (const Touch& touch : touches_) {
    const glm::dvec3 slip = slip_of(touch, v), force = -friction_of(touch, slip) * slip;
    for (std::size_t n = 0; n < touch.at.size(); ++n) F[std::size_t(touch.at[n])] += touch.weights[n] * force;
  }
}

std::vector<SelfContact::Resistance> SelfContact::resistances(Vectors v) const {
  std::vector<Resistance> all;
  all.reserve(touches_.size());
  for (const Touch& touch : touches_)
    all.push_back({touch.at, touch.weights, touch.normal, 12 * k_ / (d_ * d_) * touch.s * touch.s,
                   has_friction() ? friction_of(touch, slip_of(touch, v)) : 0});
  return all;
}

/// δ, where coordinates are that large, m: positions may be kept in float.
double SelfContact::least_gap(double farthest) const {
  constexpr double roundings = 8;
  return std::max(least_gap_per_L * L_, roundings * double(std::numeric_limits<float>::epsilon()) * farthest);
}

double SelfContact::least_room() const {
  return share_of_gap / 2 * std::max(nearest_ - least_gap(pairs_.farthest()), 0.0);
}

std::span<const SelfContact::Held> SelfContact::hold_back(Vectors x_before, std::span<glm::dvec3> x, bool free) {
  assert(x_before.size() == x.size());
  held_.clear();
  common_ = glm::dvec3(0);
  if (free) {
    for (std::size_t p = 0; p < x.size(); ++p) common_ += x[p] - x_before[p];
    common_ /= double(x.size());
  }
  const auto length = [&](std::size_t p) { return glm::length(x[p] - x_before[p] - common_); };
  double longest = 0, farthest = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    longest = std::max(longest, length(p));
    for (int c = 0; c < 3; ++c)
      farthest = std::max({farthest, std::abs(x_before[p][c]), std::abs(x_before[p][c] + common_[c])});
  }
  const double least = least_gap(farthest);
  if (!(least < reach_per_L * L_)) return held_;  // so far away that nothing is told apart: the motion diverges
  // Pairs that are farther apart cut nothing short.
  const double below = std::min(reach_per_L * L_, (longest / (share_of_gap / 2) + least) * (1 + 1e-9));
  if (longest <= share_of_gap / 2 * (nearest_ - least)) return held_;
  room_.assign(x.size(), below);
  pairs_.follow(x_before);
  pairs_.measure(below, x_before, [&](const std::array<int, 4>& at, const Gap&, double distance) {
    for (const int particle : at) room_[std::size_t(particle)] = std::min(room_[std::size_t(particle)], distance);
  });
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double way = length(p), most = share_of_gap / 2 * std::max(room_[p] - least, 0.0);
    if (!(way > most) || !std::isfinite(way)) continue;
    x[p] = x_before[p] + common_ + most / way * (x[p] - x_before[p] - common_);
    held_.push_back({int(p), most / way});
  }
  return held_;
}

std::size_t SelfContact::bytes() const {
  return pairs_.bytes() + sides_.capacity() * sizeof(Side) + held_.capacity() * sizeof(Held) +
         room_.capacity() * sizeof(double) + touches_.capacity() * sizeof(Touch);
}

}  // namespace tyglab

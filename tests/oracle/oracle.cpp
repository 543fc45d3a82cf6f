#include "tests/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tyglab::oracle {
namespace {

constexpr double pi = 3.141592653589793;

/// (sin, cos) of an angle in degrees, exact at multiples of 90.
std::pair<double, double> sin_cos(double degrees) {
  const double turn = std::fmod(std::fmod(degrees, 360) + 360, 360);
  if (turn == 0) return {0, 1};
  if (turn == 90) return {1, 0};
  if (turn == 180) return {0, -1};
  if (turn == 270) return {-1, 0};
  return {std::sin(turn * pi / 180), std::cos(turn * pi / 180)};
}

double ulp(double value) {
  return std::nextafter(value, std::numeric_limits<double>::infinity()) - value;
}

/// How deep x is inside the body; negative outside.
double depth(const Body& body, Vec x) {
  return body.shape == Body::Shape::sphere ? body.r - glm::length(x - body.c) : body.y - x.y;
}

/// (2.9) for a sphere, taken literally.
bool is_inside(const Body& body, Vec x) {
  if (body.shape == Body::Shape::plane) return x.y < body.y;
  return glm::dot(x - body.c, x - body.c) < body.r * body.r;
}

/// Surface normal seen from x; +y at a sphere's center.
Vec normal(const Body& body, Vec x) {
  if (body.shape == Body::Shape::plane || x == body.c) return {0, 1, 0};
  return glm::normalize(x - body.c);
}

Vec nearest_surface(const Body& body, Vec x) {
  return body.shape == Body::Shape::plane ? Vec(x.x, body.y, x.z) : body.c + body.r * normal(body, x);
}

/// Where the ray from x (inside) along N leaves the body.
Vec surface_along(const Body& body, Vec x, Vec N) {
  if (body.shape == Body::Shape::plane) return {x.x, body.y, x.z};
  const Vec q = x - body.c;
  const double b = glm::dot(q, N);
  return x + (-b + std::sqrt(b * b - glm::dot(q, q) + body.r * body.r)) * N;
}

/// "The old position was inside already" is read as: deeper inside than a collision may leave a particle, 8 ulp of the
/// largest of |x|, |c|, r. A particle that rests on a surface is on either side of it by rounding and must keep
/// friction and restitution.
bool was_inside(const Body& body, Vec old) {
  const double size = body.shape == Body::Shape::sphere ? std::max({glm::length(old), glm::length(body.c), body.r})
                                                        : std::max(glm::length(old), std::abs(body.y));
  return depth(body, old) > 8 * ulp(size);
}

/// The corrected velocity: inward normal part reversed and scaled by e, tangential part shortened by at most μ times
/// the change of the normal part. Where the body returns at most nine tenths of a speed, nothing slower than
/// 3.5/(1 - e) times what weight adds in a step bounces.
Vec corrected_velocity(const Body& body, Vec N, Vec v, double weight_speed) {
  const double v_n = glm::dot(v, N);
  if (v_n >= 0) return v;
  const Vec v_t = v - v_n * N;
  const bool rests = body.restitution <= 0.9 && -v_n * (1 - body.restitution) < 3.5 * weight_speed;
  const double e = rests ? 0 : body.restitution;
  const double change = (1 + e) * -v_n;
  const double speed = glm::length(v_t);
  const double kept = speed > 0 ? std::max(0.0, 1 - body.friction * change / speed) : 0;
  return -e * v_n * N + kept * v_t;
}

}  // namespace

Cloth::Cloth(const Preset& preset) : p_(preset), particles_(std::size_t(preset.rows) * preset.columns) {
  place();
  pin();
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) {
      for (int k = 0; k < 8; ++k) at(i, j).whole[k] = contains(i + ring[k].di, j + ring[k].dj);
    }
  }
  start();
}

void Cloth::start() {
  if (held_ >= 0) particles_[held_].v = hand_;
  full_step_.clear();
  for (const Particle& particle : particles_) full_step_.push_back(particle.v);
  const auto blowing = outer();
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) {
      at(i, j).d = p_.dt * at(i, j).v - p_.dt * p_.dt / 2 * acceleration(i, j, blowing);
    }
  }
  if (p_.integrator != "verlet") return;
  // Only now: a(x, v) of the neighbors needed the velocities of the start.
  for (Particle& particle : particles_) particle.v = particle.d / p_.dt;
}

void Cloth::place() {
  const auto [sine, cosine] = sin_cos(p_.tilt_deg);
  const double step = p_.initial_stretch * p_.L;
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) {
      at(i, j).x = p_.x_0 + Vec((j - (p_.columns - 1) / 2.0) * step, -sine * i * step, cosine * i * step);
      at(i, j).v = p_.v_0;
    }
  }
}

void Cloth::pin() {
  const int last_row = p_.rows - 1, last_column = p_.columns - 1;
  for (int i = 0; i <= last_row; ++i) {
    for (int j = 0; j <= last_column; ++j) {
      const bool top = i == 0, bottom = i == last_row, left = j == 0, right = j == last_column;
      bool pinned = false;
      switch (p_.pins.mode) {
        case Pins::Mode::none:
          break;
        case Pins::Mode::top_row:
          pinned = top;
          break;
        case Pins::Mode::top_corners:
          pinned = top && (left || right);
          break;
        case Pins::Mode::four_corners:
          pinned = (top || bottom) && (left || right);
          break;
        case Pins::Mode::left_column:
          pinned = left;
          break;
        case Pins::Mode::boundary:
          pinned = top || bottom || left || right;
          break;
        case Pins::Mode::list:
          for (const Pins::Site& site : p_.pins.list) pinned = pinned || (site.i == i && site.j == j);
          break;
      }
      at(i, j).pinned = pinned;
      if (pinned) at(i, j).v = Vec(0);
    }
  }
}

double Cloth::constant(const Offset& to) const {
  const double own = to.di == 0 ? p_.k_weft : to.dj == 0 ? p_.k_warp : p_.k_shear;
  return own < 0 ? p_.k_s : own;
}

Forces Cloth::gather(int i, int j) const {
  const Particle& self = at(i, j);
  Forces forces;
  for (int k = 0; k < 8; ++k) {
    if (!self.whole[k]) continue;
    const Particle& other = at(i + ring[k].di, j + ring[k].dj);
    const double rest = ring[k].di != 0 && ring[k].dj != 0 ? std::sqrt(2.0) * p_.L : p_.L;
    const Vec x_ij = other.x - self.x;  // (2.4)
    const double length = glm::length(x_ij);
    if (length >= rest) forces.F_s += constant(ring[k]) * (length - rest) * x_ij / length;  // (2.5)
    forces.F_d += -p_.k_d * (self.v - other.v);                                             // (2.6)
  }
  for (const int k : {1, 3, 4, 6}) {  // up, left, right, down
    if (!self.whole[k] || !at(i + ring[k].di, j + ring[k].dj).whole[k]) continue;
    const double rest = 2 * p_.L;
    const Vec x_ij = at(i + 2 * ring[k].di, j + 2 * ring[k].dj).x - self.x;
    const double length = glm::length(x_ij);
    if (length < rest && length >= 1e-9 * rest) forces.F_b += p_.k_b * (length - rest) * x_ij / length;  // (2.7)
  }
  forces.F_g = Vec(0, -p_.m * p_.g, 0);
  return forces;
}

void Cloth::blow(Outer& force, const std::array<Offset, 3>& corners) const {
  const auto& [a, b, c] = corners;
  if (!whole(a.di, a.dj, b.di, b.dj) || !whole(b.di, b.dj, c.di, c.dj) || !whole(c.di, c.dj, a.di, a.dj)) return;
  const Vec area = glm::cross(at(b.di, b.dj).x - at(a.di, a.dj).x, at(c.di, c.dj).x - at(a.di, a.dj).x);
  if (area == Vec(0)) return;
  const Vec N = glm::normalize(area);
  const Vec u = p_.u - (at(a.di, a.dj).v + at(b.di, b.dj).v + at(c.di, c.dj).v) / 3.0;  // of the air past the triangle
  const double speed = glm::length(u), A = glm::length(area) / 2, head_on = glm::dot(u, N);
  const Vec drag =
      p_.air_density / 2 * A * (p_.C_N * std::abs(head_on) * head_on * N + p_.C_T * speed * (u - head_on * N));
  for (const Offset& corner : corners) {
    const int p = index(corner.di, corner.dj);
    force.wind[p] += N * glm::dot(N, p_.W) / 3.0;  // (2.16)
    force.air[p] += drag / 3.0;
  }
}

Cloth::Outer Cloth::outer() const {
  const std::vector<Vec> none(particles_.size(), Vec(0));
  Outer force{none, none};
  for (int i = 0; i + 1 < p_.rows; ++i) {
    for (int j = 0; j + 1 < p_.columns; ++j) {
      const Offset top_left{i, j}, top_right{i, j + 1}, bottom_left{i + 1, j}, bottom_right{i + 1, j + 1};
      if ((i + j) % 2 == 0) {
        blow(force, {top_left, bottom_left, bottom_right});
        blow(force, {top_left, bottom_right, top_right});
      } else {
        blow(force, {top_left, bottom_left, top_right});
        blow(force, {bottom_left, bottom_right, top_right});
      }
    }
  }
  return force;
}

Forces Cloth::forces(int i, int j) const {
  Forces forces = gather(i, j);
  const Outer blowing = outer();
  forces.F_wind = blowing.wind[index(i, j)], forces.F_air = blowing.air[index(i, j)];
  return forces;
}

Vec Cloth::acceleration(int i, int j, const Outer& blowing) const {
  if (at(i, j).pinned || is_held(i, j)) return Vec(0);
  return (gather(i, j).F() + blowing.wind[index(i, j)] + blowing.air[index(i, j)]) / p_.m;
}

Vec Cloth::velocity(int i, int j) const {
  if (!full_step_.empty()) return full_step_[index(i, j)];
  if (p_.integrator != "verlet") return at(i, j).v;
  return at(i, j).v + p_.dt / 2 * acceleration(i, j, outer());
}

void Cloth::edit(const std::function<void()>& what) {
  std::vector<Vec> v;
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) v.push_back(is_held(i, j) ? hand_ : velocity(i, j));
  }
  what();
  for (std::size_t p = 0; p < v.size(); ++p) particles_[p].v = v[p];
  start();
}

void Cloth::step() {
  full_step_.clear();
  if (held_ >= 0) {
    particles_[held_].v = hand_;
    particles_[held_].d = p_.dt * hand_;
  }
  const auto blowing = outer();
  std::vector<Vec> a;
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) a.push_back(acceleration(i, j, blowing));
  }
  for (int p = 0; p < int(particles_.size()); ++p) {
    if (particles_[p].pinned) continue;
    if (p == held_) {
      particles_[p].x += p_.dt * hand_;
    } else {
      move(particles_[p], a[p]);
    }
  }
  if (p_.F_max > 0) tear();
  if (hand_steps_ > 0 && --hand_steps_ == 0) edit([&] { hand_ = Vec(0); });
}

void Cloth::advance(int steps) {
  for (int n = 0; n < steps; ++n) step();
}

void Cloth::move(Particle& particle, Vec a) const {
  const double dt = p_.dt;
  const Vec old = particle.x;
  Vec x, v;
  if (p_.integrator == "euler") {  // (2.10)
    x = old + dt * particle.v;
    v = particle.v + dt * a;
  } else if (p_.integrator == "improved_euler") {  // (2.11)
    x = old + dt * particle.v + dt * dt / 2 * a;
    v = particle.v + dt * a;
  } else {  // (2.15)
    particle.d += dt * dt * a;
    x = old + particle.d;
    v = particle.d / dt;
  }
  const Vec tentative = v;
  collide(old, x, v);
  particle.x = x;
  particle.v = v;
  if (v != tentative) particle.d = dt * v;
}

void Cloth::collide(Vec old, Vec& x, Vec& v) const {
  for (int pass = 0; pass < 4; ++pass) {
    for (const Body& body : p_.bodies) {
      if (!is_inside(body, x)) continue;
      const Vec N = normal(body, old);
      if (was_inside(body, old)) {
        // No friction and no restitution: nothing struck anything.
        x = surface_along(body, x, N);
        v -= std::min(0.0, glm::dot(v, N)) * N;
        continue;
      }
      v = corrected_velocity(body, N, v, p_.g * p_.dt);
      x = old + p_.dt * v;
      if (is_inside(body, x)) x = nearest_surface(body, x);
    }
  }
}

bool Cloth::whole(int i, int j, int i2, int j2) const {
  for (int k = 0; k < 8; ++k) {
    if (i + ring[k].di == i2 && j + ring[k].dj == j2) return at(i, j).whole[k];
  }
  return false;
}

void Cloth::break_spring(int i, int j, int k) {
  if (!contains(i + ring[k].di, j + ring[k].dj)) return;
  at(i, j).whole[k] = false;
  at(i + ring[k].di, j + ring[k].dj).whole[7 - k] = false;
}

bool Cloth::guarded(int i, int j) const {
  for (int di = -1; di <= 1; ++di) {
    for (int dj = -1; dj <= 1; ++dj) {
      if (!contains(i + di, j + dj)) continue;
      if (at(i + di, j + dj).pinned || is_held(i + di, j + dj)) return true;
    }
  }
  return false;
}

void Cloth::tear() {
  for (int i = 0; i < p_.rows; ++i) {
    for (int j = 0; j < p_.columns; ++j) {
      for (int k = 0; k < 8; ++k) {
        const int i2 = i + ring[k].di, j2 = j + ring[k].dj;
        if (!at(i, j).whole[k] || guarded(i, j) || guarded(i2, j2)) continue;
        const double rest = ring[k].di != 0 && ring[k].dj != 0 ? std::sqrt(2.0) * p_.L : p_.L;
        if (constant(ring[k]) * (glm::length(at(i2, j2).x - at(i, j).x) - rest) > p_.F_max) break_spring(i, j, k);
      }
    }
  }
}

void Cloth::set_dt(double dt) {
  edit([&] { p_.dt = dt; });
}

void Cloth::grab(int i, int j) {
  edit([&] { held_ = index(i, j), hand_ = Vec(0), hand_steps_ = 0; });
}

void Cloth::move_hand(Vec to, int steps) {
  edit([&] { hand_ = (to - particles_[held_].x) / (steps * p_.dt), hand_steps_ = steps; });
}

void Cloth::release() {
  edit([&] { held_ = -1; });
}

void Cloth::cut(int i, int j) {
  edit([&] {
    for (int k = 0; k < 3; ++k) break_spring(i, j, k);
  });
}

Weight::Weight(const Preset& preset) : y(preset.x_0.y + preset.offset), v(preset.v_0.y), d(0), p_(preset) {
  d = p_.dt * v - p_.dt * p_.dt / 2 * a();
  if (p_.integrator == "verlet") v = d / p_.dt;
}

double Weight::a() const {
  return (-p_.k * (y - p_.x_0.y) - p_.k_d * v - p_.m * p_.g) / p_.m;
}

void Weight::step() {
  const double a_n = a(), dt = p_.dt;
  if (p_.integrator == "verlet") {
    d += dt * dt * a_n;
    y += d;
    v = d / dt;
    return;
  }
  y += dt * v + (p_.integrator == "improved_euler" ? dt * dt / 2 * a_n : 0);
  v += dt * a_n;
}

}  // namespace tyglab::oracle

#include "core/model/notation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <sstream>
#include <type_traits>

#include "core/model/words.h"

namespace tyglab {
namespace {

using enum Scale;
using enum Effect;

const auto rows = std::to_array<PresetRow>({
    {"cloth", "rows", "R", "Rows of particles", "Partikelrader", "", &Preset::rows, 2, 4096, logarithmic, rebuild, "",
     "Particles from top to bottom; a change rebuilds the cloth.", false, Kind::cloth, true},
    {"cloth", "columns", "C", "Columns of particles", "Partikelkolumner", "", &Preset::columns, 1, 4096, logarithmic,
     rebuild, "", "Particles from left to right; a change rebuilds the cloth.", false, Kind::cloth, true},
    {"cloth", "L", "L", "Rest length of a spring", "Fjäders vilolängd", "m", &Preset::L, 1e-4, 10, logarithmic, force,
     "2.5", "Spacing of the lattice: diagonals rest at √2·L, bending springs at 2L.", false, Kind::cloth, true},
    {"cloth", "m", "m", "Mass of a particle", "Partikelmassa", "kg", &Preset::m, 1e-9, 1e3, logarithmic, force, "2.1",
     "A lighter particle moves faster and needs a smaller time step."},
    {"cloth", "x_0", "x_0", "Original position (middle of the top row)", "Ursprungsposition", "m", &Preset::x_0, -1e3,
     1e3, linear, start, "2.3", "Start position; for a mass on a spring, x_0.y is the rest position of the spring.",
     false, Kind::cloth, false, force},
    {"cloth", "v_0", "v_0", "Original velocity", "Ursprungshastighet", "m/s", &Preset::v_0, -1e3, 1e3, linear, start,
     "", "Initial velocity of all free particles."},
    {"cloth", "tilt_deg", "θ", "Tilt (90 hangs, 0 lies flat)", "Lutning", "°", &Preset::tilt_deg, -360, 360, linear,
     start, "", "Angle of the cloth at the start.", false, Kind::cloth, true},
    {"cloth", "initial_stretch", "s", "Initial stretch (1 at rest length)", "Ursprunglig töjning", "",
     &Preset::initial_stretch, 0.1, 10, linear, start, "", "Above 1 every spring starts taut.", false, Kind::cloth,
     true},
    {"cloth", "offset", "y_start", "Start above the rest position", "Startläge över viloläget", "m", &Preset::offset,
     -1e3, 1e3, linear, start, "2.3", "Release point of the mass on a spring.", false, Kind::one_weight, true},

    {"forces", "k_s", "k_s", "Spring constant, stretching", "Fjäderkonstant töjning", "N/m", &Preset::k_s, 0, 1e9,
     logarithmic, force, "2.5", "Stiffness against stretching. A higher value requires a smaller time step.", false,
     Kind::cloth, true},
    {"forces",
     "k_warp",
     "k_warp",
     "Spring constant of the warp",
     "Fjäderkonstant varp",
     "N/m",
     &Preset::k_warp,
     0,
     1e9,
     logarithmic,
     force,
     "",
     "Stiffness of the threads down the columns; as k_s unless it is set.",
     false,
     Kind::cloth,
     true,
     {},
     1,
     "k_s"},
    {"forces",
     "k_weft",
     "k_weft",
     "Spring constant of the weft",
     "Fjäderkonstant inslag",
     "N/m",
     &Preset::k_weft,
     0,
     1e9,
     logarithmic,
     force,
     "",
     "Stiffness of the threads along the rows; as k_s unless it is set.",
     false,
     Kind::cloth,
     true,
     {},
     1,
     "k_s"},
    {"forces",
     "k_shear",
     "k_shear",
     "Spring constant of the diagonals",
     "Fjäderkonstant skjuvning",
     "N/m",
     &Preset::k_shear,
     0,
     1e9,
     logarithmic,
     force,
     "",
     "Stiffness against shear, when rows and columns no longer meet at right angles; as k_s unless it is set.",
     false,
     Kind::cloth,
     true,
     {},
     1,
     "k_s"},
    {"forces", "k_b", "k_b", "Spring constant, bending", "Fjäderkonstant böjning", "N/m", &Preset::k_b, 0, 1e9,
     logarithmic, force, "2.7", "Stiffness against folding.", false, Kind::cloth, true},
    {"forces",
     "B",
     "B",
     "Bending rigidity",
     "Böjstyvhet",
     "N m",
     &Preset::B,
     0,
     1e3,
     logarithmic,
     force,
     "",
     "Moment that bends a strip of width 1 m to the curvature 1/m; 0 leaves bending to k_b.",
     true,
     Kind::cloth,
     true,
     {},
     1e-4},
    {"forces", "twist", "t_B", "Resistance to twist, as a fraction of B's", "Vridning", "", &Preset::twist, 0, 1,
     linear, force, "", "1: bending is equally stiff in all directions; 0: rows and columns bend on their own.", false,
     Kind::cloth, true},
    {"forces",
     "kappa_warp",
     "κ_warp",
     "Rest curvature of the warp",
     "Vilokrökning varp",
     "1/m",
     &Preset::kappa_warp,
     -1e3,
     1e3,
     linear,
     force,
     "",
     "Curvature of the threads down the columns at rest, for B: above 0 they curl to the front.",
     false,
     Kind::cloth,
     true,
     {},
     10},
    {"forces",
     "kappa_weft",
     "κ_weft",
     "Rest curvature of the weft",
     "Vilokrökning inslag",
     "1/m",
     &Preset::kappa_weft,
     -1e3,
     1e3,
     linear,
     force,
     "",
     "Curvature of the threads along the rows at rest, for B.",
     false,
     Kind::cloth,
     true,
     {},
     10},
    {"forces", "k_d", "k_d", "Damping constant", "Fjäderkonstant dämpning", "N s/m", &Preset::k_d, 0, 1e6, logarithmic,
     force, "2.6", "Resistance to relative motion along stretch springs: from denim (low) to rubber mat (high)."},
    {"forces", "k", "k", "Spring constant of the mass on a spring", "Fjäderkonstant", "N/m", &Preset::k, 0, 1e9,
     logarithmic, force, "2.3", "Hooke's two-sided spring of figure 3.2.", false, Kind::one_weight, true},
    {"forces", "g", "g", "Gravitational acceleration", "Tyngdacceleration", "m/s²", &Preset::g, -100, 100, linear,
     force, "2.2", "Acts along -y: F_g = m·g."},
    {"forces", "W", "W", "Wind", "Vind", "N", &Preset::W, -1e3, 1e3, linear, force, "2.16",
     "Force on each triangle along its normal: N (N·W).", false, Kind::cloth, true},
    {"forces",
     "air_density",
     "ρ_air",
     "Density of the air",
     "Luftens densitet",
     "kg/m³",
     &Preset::air_density,
     0,
     1e4,
     logarithmic,
     force,
     "",
     "Air resists motion through it and carries the cloth along with u; 1.2 at sea level, 0 leaves it out.",
     true,
     Kind::cloth,
     true,
     {},
     1.2},
    {"forces", "u", "u", "Velocity of the air", "Luftens hastighet", "m/s", &Preset::u, -1e3, 1e3, linear, force, "",
     "Wind as a velocity: acts where ρ_air is above 0, by area and by the cloth's own velocity.", false, Kind::cloth,
     true},
    {"forces", "C_N", "C_N", "Air's coefficient across the cloth", "Luftmotstånd tvärs tyget", "", &Preset::C_N, 0, 100,
     linear, force, "", "Force on a triangle along its normal: ½ρA·C_N|u·N|(u·N), u relative to it.", false,
     Kind::cloth, true},
    {"forces", "C_T", "C_T", "Air's coefficient along the cloth", "Luftmotstånd längs tyget", "", &Preset::C_T, 0, 100,
     linear, force, "", "Force on a triangle in its plane: ½ρA·C_T|u|u_t, u relative to it.", false, Kind::cloth, true},
    {"forces", "gust", "W_gust", "Strength of gusts, as a fraction of the wind", "Vindbyarnas styrka", "",
     &Preset::gust, 0, 10, linear, force, "",
     "W and u rise and fall by up to this fraction; 0 gives the report's steady wind.", false, Kind::cloth, true},
    {"forces", "gust_period", "T_gust", "Period of the gusts", "Vindbyarnas period", "s", &Preset::gust_period, 0.01,
     1e3, logarithmic, force, "", "Time from one gust to the next; two shorter waves are superimposed.", false,
     Kind::cloth, true},

    {"tearing", "F_max", "F_max", "Largest force that a spring can carry", "Maximal fjäderkraft", "N", &Preset::F_max,
     0, 1e9, logarithmic, tearing, "", "A stretch spring whose F_s is larger breaks permanently.", true, Kind::cloth,
     true},
    {"tearing", "F_release", "F_release", "Force at which the hand lets go", "Kraft då greppet släpper", "N",
     &Preset::F_release, 0, 1e9, logarithmic, tearing, "", "A larger force releases the held particle.", true,
     Kind::cloth, true},

    {"tearing", "tearing.mode", "", "What an overload does", "Vad en överlast gör", "", &Preset::tearing, 0, 0, linear,
     tearing, "3.2.3",
     "springs: the spring breaks, and triangles that it bounds vanish (the report's rule); split: particles part and "
     "the cloth opens between its cells.",
     false, Kind::cloth, true},

    {"contact", "self", "", "Contact of the cloth with itself", "Självkontakt", "", &Preset::self, 0, 0, linear, force,
     "",
     "off: the cloth passes through itself; repel: near layers repel each other, which promises nothing; guard: a "
     "bound "
     "of each step's motion also keeps layers from crossing.",
     false, Kind::cloth, true},
    {"contact", "thickness", "r_c", "Thickness in contact", "Kontakttjocklek", "m", &Preset::thickness, 0, 100,
     logarithmic, force, "", "Layers begin to repel each other at twice this distance; 0: 0.15 L.", false, Kind::cloth,
     true},
    {"contact", "friction", "μ_c", "Friction between layers", "Friktion mellan lager", "", &Preset::self_friction, 0,
     10, linear, force, "", "Coulomb friction between layers of the cloth.", true, Kind::cloth, true},

    {"solver", "integrator", "", "Integrator", "Approximationsmetod", "", &Preset::integrator, 0, 0, linear, integrator,
     "2.10", "Method that advances x and ẋ from one time step to the next."},
    {"solver", "dt", "dt", "Time step", "Tidssteg", "s", &Preset::dt, 1e-7, 1, logarithmic, dt, "2.10",
     "A step that is too large makes the simulation unstable."},
    {"solver", "tolerance", "tol", "Tolerance of adaptive methods", "Tolerans", "m", &Preset::tolerance, 1e-12, 1,
     logarithmic, tolerance, "", "Error allowed in a step by methods that choose their own steps."},
    {"solver", "iterations", "n_iter", "Largest number of iterations in a step", "Iterationer", "", &Preset::iterations,
     1, 1000, logarithmic, tolerance, "",
     "Implicit methods: largest number of Newton steps in a solve; 1 makes a single linear solve. "
     "projective_dynamics, vbd, xpbd: passes per step."},
    {"solver", "contact", "", "Time of contact", "Kollisionstidpunkt", "", &Preset::contact, 0, 0, linear, bodies,
     "2.1.5",
     "local: particles meet bodies when they do, within the step; step: at its end, the report's rule; global: each "
     "step is split at every impact, which is slow and keeps the method's order."},

    {"view", "mode", "", "View", "Vy", "", &Preset::mode, 1, 5, linear, view, "",
     "1 triangles, 2 connections, 3 both, 4 outlines, 5 points."},
    {"view", "texture", "", "Texture", "Textur", "", &Preset::texture, 0, 0, linear, texture, "",
     "A shipped texture's name or a PNG, JPEG, BMP or TGA file."},
});

const auto body_rows = std::to_array<BodyRow>({
    {"bodies", "c", "c", "Center of a body", "Centrumpunkt", "m", &Body::c, -1e3, 1e3, linear, bodies, "2.9",
     "Where the body's center is at the start."},
    {"bodies", "r", "r", "Radius", "Radie", "m", &Body::r, 1e-3, 100, logarithmic, bodies, "2.9",
     "Of a sphere, capsule or cylinder. A particle is inside a sphere if (x - c)·(x - c) < r²."},
    {"bodies", "size", "a", "Edges of a box", "Kantlängder", "m", &Body::size, 1e-3, 200, logarithmic, bodies, "",
     "Edges along the box's own x, y and z."},
    {"bodies", "length", "l", "Length", "Längd", "m", &Body::length, 1e-3, 200, logarithmic, bodies, "",
     "Of a cylinder, or of a capsule between the centers of its round ends; along its own y axis."},
    {"bodies", "y", "y", "Height of a plane", "Planets höjd", "m", &Body::y, -1e3, 1e3, linear, bodies, "",
     "The plane passes through (0, y, 0) at the start; particles stay above it."},
    {"bodies", "turn", "φ", "Rotation", "Vridning", "°", &Body::turn, -360, 360, linear, bodies, "",
     "At the start, about x, then y, then z; spheres have none."},
    {"bodies", "velocity", "v", "Velocity of a body", "Kroppens hastighet", "m/s", &Body::velocity, -100, 100, linear,
     bodies, "", "The body's center moves that fast from the start on."},
    {"bodies", "spin", "ω", "Angular velocity", "Vinkelhastighet", "rad/s", &Body::spin, -1e3, 1e3, linear, bodies, "",
     "About the body's center; friction drags the cloth along."},
    {"bodies", "friction", "μ", "Friction", "Friktion", "", &Body::friction, 0, 10, linear, bodies, "",
     "Coulomb's coefficient: tangential velocity lost per normal velocity lost."},
    {"bodies", "restitution", "e", "Restitution", "Studskoefficient", "", &Body::restitution, 0, 1, linear, bodies, "",
     "0: the inward velocity is removed; 1: it is reversed."},
});

const auto variable_rows = std::to_array<Variable>({
    {"F", "F", "Total force", "Total kraft", "N", "2.2", "All forces on the particle."},
    {"F_s", "F_s", "Stretching force", "Töjningskraft", "N", "2.5", "Sum over the eight stretch springs."},
    {"F_b", "F_b", "Bending force", "Böjningskraft", "N", "2.7", "Sum over the four bending springs."},
    {"F_B", "F_B", "Force of the bending rigidity", "Böjstyvhetens kraft", "N", "",
     "Resistance to curvature along rows and columns and to twist."},
    {"F_curl", "F_curl", "Force of the rest curvature", "Vilokrökningens kraft", "N", "",
     "What B does to curl the cloth to κ_warp and κ_weft."},
    {"F_d", "F_d", "Damping force", "Dämpningskraft", "N", "2.6", "Sum over the eight stretch springs."},
    {"F_self", "F_self", "Force between layers", "Kraft mellan lager", "N", "",
     "What keeps layers of the cloth apart that are near each other."},
    {"F_slip", "F_slip", "Friction between layers", "Friktion mellan lager", "N", "",
     "What acts against the slip of layers that touch."},
    {"F_g", "F_g", "Gravitational force", "Gravitationskraft", "N", "2.2", "m·g, downward."},
    {"F_wind", "F_wind", "Wind force", "Vindkraft", "N", "2.16", "Sum over the triangles at the particle."},
    {"F_air", "F_air", "Force of the air", "Luftens kraft", "N", "",
     "Drag and lift, a third of those on each triangle at the particle."},
    {"F_int", "F_int", "Internal forces", "Interna krafter", "N", "2.2",
     "Forces between particles: F_s + F_b + F_B + F_curl + F_d + F_self + F_slip."},
    {"F_ext", "F_ext", "External forces", "Externa krafter", "N", "2.2", "Gravity, wind, air and the hand."},
    {"x", "x", "Position", "Position", "m", "2.4", "Position of the particle."},
    {"v", "x'", "Velocity", "Hastighet", "m/s", "2.10", "Velocity of the particle, at the time of its position."},
    {"a", "x''", "Acceleration", "Acceleration", "m/s²", "2.1", "F/m; 0 for a pinned particle."},
});

/// Capitals count as small letters.
int edit_distance(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int next = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (small(a[i - 1]) != small(b[j - 1]))});
      diagonal = row[j];
      row[j] = next;
    }
  }
  return row.back();
}

template <class T>
std::string range_text(const Row<T>& row) {
  return row.max > row.min ? shortest_number(row.min) + " to " + shortest_number(row.max) : std::string("–");
}

template <class T>
std::string default_text(const Row<T>& row) {
  return std::visit(
      [&](auto field) -> std::string {
        static const T defaults;
        const auto& value = defaults.*field;
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::string>)
          return "`" + value + "`";
        else if constexpr (std::is_same_v<Value, glm::dvec3>)
          return "[" + shortest_number(value.x) + ", " + shortest_number(value.y) + ", " + shortest_number(value.z) +
                 "]";
        else
          return is_absent(row, double(value))   ? "absent: " + std::string(row.otherwise)
                 : row.zero_is_off && value == 0 ? "0 (never)"
                                                 : shortest_number(double(value));
      },
      row.field);
}

template <class T>
void table(std::ostringstream& out, std::span<const Row<T>> list) {
  out << "| Key | Symbol | Quantity | Storhet | Unit | Allowed | Default | Equation | Meaning |\n"
         "|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& row : list)
    out << "| `" << row.section << '.' << row.key_in_section() << "` | " << (row.symbol.empty() ? "–" : row.symbol)
        << " | " << row.quantity << " | " << row.storhet << " | " << (row.unit.empty() ? "–" : row.unit) << " | "
        << range_text(row) << " | " << default_text(row) << " | " << (row.equation.empty() ? "–" : row.equation)
        << " | " << row.help << " |\n";
}

}  // namespace

std::span<const PresetRow> notation() {
  return rows;
}
std::span<const Heading> headings() {
  static const std::array<Heading, 8> list{{
      {"Integrator", "solver", {"dt", "tolerance", "iterations"}},
      {"Springs", "forces", {"k_s", "k_b", "B", "twist", "kappa_warp", "kappa_weft", "k_d", "k"}},
      {"Fabric", "", {"k_warp", "k_weft", "k_shear"}},
      {"Outer forces", "", {"g", "W", "air_density", "u", "C_N", "C_T", "gust", "gust_period"}},
      {"Tearing", "tearing", {"F_max", "F_release"}},
      {"Self-contact", "contact", {"thickness", "friction"}},
      {"Cloth", "cloth", {"rows", "columns", "L", "m"}},
      {"Start", "", {"x_0", "v_0", "tilt_deg", "initial_stretch", "offset"}},
  }};
  return list;
}

std::string_view heading_of(const PresetRow& row) {
  for (const Heading& heading : headings())
    if (std::find(heading.keys.begin(), heading.keys.end(), row.key) != heading.keys.end()) return heading.name;
  return "constants";
}

std::span<const BodyRow> body_notation() {
  return body_rows;
}
std::span<const Variable> variables() {
  return variable_rows;
}

const PresetRow* find_row(std::string_view key) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const PresetRow& r) { return r.key == key; });
  return row == rows.end() ? nullptr : &*row;
}

const BodyRow* find_body_row(std::string_view key) {
  const auto row = std::find_if(body_rows.begin(), body_rows.end(), [&](const BodyRow& r) { return r.key == key; });
  return row == body_rows.end() ? nullptr : &*row;
}

bool shape_has(Body::Shape shape, std::string_view key) {
  using Shape = Body::Shape;
  if (key == "y") return shape == Shape::plane;
  if (key == "c") return shape != Shape::plane;
  if (key == "r") return shape != Shape::plane && shape != Shape::box;
  if (key == "size") return shape == Shape::box;
  if (key == "length") return shape == Shape::capsule || shape == Shape::cylinder;
  return key != "turn" || shape != Shape::sphere;
}

std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known) {
  // A key longer than any known one by far cannot be a slip of the finger, and would only cost time.
  if (word.size() > 64) return std::nullopt;
  std::optional<std::string_view> best;
  // Nor is one meant of which no letter is left.
  int best_distance = std::min(std::max(2, int(word.size()) / 3) + 1, int(word.size()));
  for (std::string_view candidate : known) {
    const int distance = edit_distance(word, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known, const std::string& otherwise) {
  const auto meant = nearest(word, known);
  return meant ? "; did you mean " + std::string(*meant) + "?" : otherwise;
}

bool is_absent(const PresetRow& row, const Preset& preset) {
  const auto* number = std::get_if<double Preset::*>(&row.field);
  return number != nullptr && is_absent(row, preset.**number);
}

std::string replaced_by(const PresetRow& row, const Preset& preset) {
  std::vector<std::string_view> keys;
  for (const PresetRow& other : rows)
    if (other.otherwise == row.key) {
      if (is_absent(other, preset)) return {};
      keys.push_back(other.key);
    }
  if (keys.empty()) return {};
  return joined(std::span(keys).first(keys.size() - 1)) + " and " + std::string(keys.back());
}

double usual_value(const PresetRow& row) {
  const auto* field = std::get_if<double Preset::*>(&row.field);
  const double value = field == nullptr ? 0 : Preset{}.**field;
  return value > 0 ? value : row.usual;
}

SliderRange slider_range(const PresetRow& row, double preset_value) {
  const double v = std::abs(preset_value);
  if (row.scale == Scale::logarithmic) {
    const double center = v > 0 ? v : usual_value(row);
    const double low = row.min == 0 ? 0 : std::max(row.min, center / 31.6);
    return {low, std::clamp(center * 31.6, row.min, row.max)};
  }
  const double reach = v > 0 ? 3 * v : 1;
  return {std::max(row.min, -reach), std::min(row.max, reach)};
}

Preset nearest_allowed(Preset preset) {
  for (const PresetRow& row : rows)
    std::visit(
        [&](auto field) {
          auto& value = preset.*field;
          using Value = std::decay_t<decltype(value)>;
          if constexpr (!std::is_same_v<Value, std::string>)
            if (!is_absent(row, preset)) value = Value(glm::clamp(value, Value(row.min), Value(row.max)));
        },
        row.field);
  return preset;
}

std::string notation_markdown() {
  std::ostringstream out;
  out << "# Notation\n\n`tyglab presets notation` generates this page from the notation table "
         "(`core/model/notation.cpp`); a test checks that it is current. Symbols are those of table B.1 of the report. "
         "Units are SI. Ranges include their ends.\n\n"
         "## Constants of a preset\n\n";
  table<Preset>(out, rows);
  out << "\nOther keys: `name`, `description`, `kind` (`cloth` or `one_weight`), `cloth.pins` (`none`, `top_row`, "
         "`top_corners`, `four_corners`, `left_column`, `boundary` or a list of [i, j]), `cloth.pin_motions` "
         "(presets.md), `solver.engine` (`cpu`, `opencl` or `plain`), `solver.precision` (`float` or `double`).\n\n## "
         "Constants of a body\n\nEach entry of "
         "`bodies` has "
         "a `shape`: `sphere` (c, r), `plane` (y, turn), `box` (c, size, turn), `capsule` or `cylinder` (c, r, "
         "length, turn). Any of them moves with `velocity` and `spin`, or its center follows a `path`: a list of "
         "[t, x, y, z] (s, m), with straight lines between.\n\n";
  table<Body>(out, body_rows);
  out << "\n## Variables\n\nShown for the picked particle, and plotted.\n\n| Symbol | Quantity | Storhet | Unit | "
         "Equation | Meaning |\n|---|---|---|---|---|---|\n";
  for (const Variable& v : variable_rows) {
    const std::string symbol = v.key == "v" ? "ẋ" : v.key == "a" ? "ẍ" : std::string(v.symbol);
    out << "| " << symbol << " | " << v.quantity << " | " << v.storhet << " | " << v.unit << " | " << v.equation
        << " | " << v.help << " |\n";
  }
  return out.str();
}

}  // namespace tyglab

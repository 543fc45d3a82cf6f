// A preset defines a complete scene, in SI units. Files, panels, `--set` and engines share this plain structure. The
// notation table (notation.h) defines ranges, symbols and meanings.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace tyglab {

enum class Kind { cloth, one_weight };
enum class Precision { float_, double_ };
enum class EngineKind { cpu, opencl, plain };

/// Where something is at a time, on a path of straight lines between keys.
struct PathKey {
  double t = 0;     ///< s
  glm::dvec3 x{0};  ///< m
  bool operator==(const PathKey&) const = default;
};
/// Before the first key it is there, after the last one it stays. `path` must not be empty.
glm::dvec3 on_path(const std::vector<PathKey>& path, double t);

/// Which particles are pinned: forces do not move them.
struct Pins {
  enum class Mode { none, top_row, top_corners, four_corners, left_column, boundary, list };
  struct Site {
    int i = 0;  ///< row, 0 at the top
    int j = 0;  ///< column, 0 at the left
    bool operator==(const Site&) const = default;
  };
  Mode mode = Mode::top_corners;
  std::vector<Site> list;  ///< used by Mode::list alone
  /// What moves some of the pinned particles: they turn about a point and go along a path.
  struct Motion {
    Mode mode = Mode::top_row;  ///< of which pinned particles
    std::vector<Site> list = {};
    std::vector<PathKey> path = {};  ///< they are as far from where they start as it is from its position at t = 0
    glm::dvec3 spin{0};              ///< angular velocity about `center`, rad/s
    glm::dvec3 center{0};            ///< at t = 0, m; it goes along the path too
    double until = 0;                ///< when the spin ends, s; 0: never
    bool operator==(const Motion&) const = default;
  };
  std::vector<Motion> motions = {};  ///< the first one that picks a particle moves it
  bool operator==(const Pins&) const = default;
};

/// A body that the cloth collides with (2.1.5). It rests, or moves as told.
struct Body {
  enum class Shape { sphere, plane, box, capsule, cylinder };
  Shape shape = Shape::sphere;
  glm::dvec3 c{0, 0, 0};           ///< center at the start, m; of all but a plane
  double r = 0.2;                  ///< radius of a sphere, capsule or cylinder, m
  double y = 0;                    ///< a plane passes through (0, y, 0) at the start, m
  glm::dvec3 size{0.4, 0.4, 0.4};  ///< edges of a box, m
  double length = 0.5;             ///< of a cylinder; of a capsule between the centers of its ends, m
  glm::dvec3 turn{0, 0, 0};        ///< at the start about x, then y, then z, degrees
  glm::dvec3 velocity{0, 0, 0};    ///< of the center, m/s
  glm::dvec3 spin{0, 0, 0};        ///< angular velocity about the center, rad/s
  std::vector<PathKey> path = {};  ///< of the center; empty: it moves at `velocity`
  double friction = 0;             ///< Coulomb's μ
  double restitution = 0;          ///< e: 0 plastic, 1 elastic
  bool operator==(const Body&) const = default;
};

/// In place of a constant that a preset leaves out, so that another one's value counts (Row::otherwise).
inline constexpr double left_out = -1;

struct Preset {
  Kind kind = Kind::cloth;
  std::string name = "Untitled";
  std::string description;

  // cloth
  int rows = 32;
  int columns = 32;
  double L = 0.03;
  double m = 0.0003;
  glm::dvec3 x_0{0, 1, 0};
  glm::dvec3 v_0{0, 0, 0};
  double tilt_deg = 85;
  double initial_stretch = 1;
  Pins pins;
  double offset = 0.1;  ///< a mass on a spring only

  // forces
  double k_s = 50;
  double k_warp = left_out;   ///< of springs down the columns, N/m; left out: k_s
  double k_weft = left_out;   ///< of springs along the rows
  double k_shear = left_out;  ///< of diagonals
  double k_b = 5;
  double B = 0;                           ///< N·m
  double twist = 1;                       ///< 0 to 1
  double kappa_warp = 0, kappa_weft = 0;  ///< curvature at rest down the columns and along the rows, 1/m
  double k_d = 0.002;
  double k = 50;  ///< a mass on a spring only
  double g = 9.82;
  glm::dvec3 W{0, 0, 0};
  double air_density = 0;   ///< kg/m³; 0: none
  double C_N = 1, C_T = 0;  ///< of the air across and along a triangle
  glm::dvec3 u{0, 0, 0};    ///< velocity of the air, m/s
  double gust = 0;          ///< 0: the wind is steady
  double gust_period = 2;   ///< s

  // tearing
  double F_max = 0;                 ///< 0: never
  double F_release = 0;             ///< 0: never
  std::string tearing = "springs";  ///< what an overload does: one of tearing_names (words.h)

  // contact of the cloth with itself
  std::string self = "off";  ///< one of self_names (words.h)
  double thickness = 0;      ///< half of the distance at which layers begin to repel each other, m; 0: 0.15 L
  double self_friction = 0;  ///< Coulomb's μ between layers

  std::vector<Body> bodies;

  // solver
  std::string integrator = "verlet";
  double dt = 0.001;
  EngineKind engine = EngineKind::cpu;
  int device = -1;  ///< number of the OpenCL device, -1: the best; a choice of this machine, so no file holds it
  Precision precision = Precision::float_;
  double tolerance = 1e-5;
  int iterations = 10;
  std::string contact = "local";  ///< when bodies act: one of contact_names (words.h)

  // view
  int mode = 1;
  std::string texture = "denim.png";

  bool operator==(const Preset&) const = default;
};

// Changes the number of particles of a cloth and keeps its size, mass and stiffness (docs/model.md, Resolution).

/// Multiplies R-1 and C-1 by q and keeps size, mass and stretch behavior of the cloth.
Preset with_resolution(const Preset& preset, double q);
/// Of two resolutions of one cloth: the particle in `to` nearest to where `site` lies in `from`.
Pins::Site site_in_resolution(Pins::Site site, const Preset& from, const Preset& to);

// Clocks for measuring steps.

/// Processor time of this thread so far, s: what another process takes meanwhile is not in it. Where no clock measures
/// it, as in a browser, time on the wall stands for it.
double thread_seconds();

/// A clock on the wall, s: a device's work is not this thread's.
double wall_seconds();

/// The one that measures an engine's steps: of the processor on the CPU, on the wall on a device.
double computing_seconds(EngineKind engine);

// Lets long work be stopped from outside: the work checks a question often.

/// Whether to stop. Asked from the threads that work, often and for as long as the work lasts, so it must be quick, may
/// be called by any thread and keeps its answer once it is yes. Empty: nobody will stop it.
using Stop = std::function<bool()>;

}  // namespace tyglab

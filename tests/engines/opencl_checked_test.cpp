// Every kernel once on a small cloth, for oclgrind: ctest runs this suite under it, which looks at every access to
// memory and for work-items that race. It does so twice: on oclgrind's device as it is, a processor, and with the layer
// tests/support/gl_sharing_double.cpp, which makes a card of it, where `look` runs too. Elsewhere the suite says
// nothing new, so it is left out.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>

#include "core/engines/opencl/card_vertices.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/opencl_engine.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/scenes.h"
#include "tests/support/skip.h"

namespace tyglab::opencl_checked_test {

bool skipped_without_oclgrind() {
  const OpenClInventory inventory = opencl_devices();
  const bool there = !inventory.devices.empty() && inventory.devices.front().platform == "Oclgrind";
  if (!there) test::skip("this program does not run under oclgrind, as ctest runs it");
  return !there;
}

bool by_the_layer() {
  return std::getenv("OPENCL_LAYERS") != nullptr;
}

/// A cloth with wind, bodies that it meets, springs that tear, and a hand that moves a particle.
Preset small(const std::string& integrator) {
  Preset preset = test::cloth(9, 7, integrator);
  preset.precision = Precision::float_;
  preset.tilt_deg = 20, preset.dt = 1e-3, preset.F_max = 0.02, preset.iterations = 1;
  preset.W = {0.001, 0.0005, 0.002};
  preset.pins.mode = Pins::Mode::left_column;
  preset.bodies = {Body{}, Body{.shape = Body::Shape::plane, .y = 0.93}};
  preset.bodies[0].c = {0.05, 0.9, 0.12}, preset.bodies[0].r = 0.1;
  return preset;
}

/// Steps one by one and several at a time, and a look. Where particles end is compared on other devices: oclgrind 21.10
/// leaves the force out of a step of vectors where there are bodies, which pocl does right in vectors of any width.
void run(const Preset& preset, int width, int steps) {
  const auto engine = opencl::make_opencl_engine(preset, lattice_of(preset), width);
  Tears tears(lattice_of(preset));
  const std::vector<int> pinned = particles_in(pinned_particles(preset));
  engine->note_contacts(true);
  engine->set_fixed(pinned, {});
  engine->load(start_rows(preset), tears);
  const std::uint64_t loaded = bytes_read(*engine);
  engine->advance(1, tears);
  engine->set_fixed(pinned, {preset.columns * 5 + 4, {0.1, 0.2, 0}});
  engine->advance(steps, tears);
  CHECK(is_remote(*engine) == by_the_layer());
  // A card has looked at its springs itself; whether the forces of an implicit stage balance is judged here.
  if (!is_implicit(scheme(preset.integrator))) CHECK(bytes_read(*engine) == loaded);
  State state;
  engine->read(state, tears);
  CHECK(test::all_finite(state));
}

TEST_SUITE("oclgrind") {
  TEST_CASE("kernels stay within their memory and do not race") {
    if (skipped_without_oclgrind()) return;
    for (const int width : {1, 4})
      for (const Scheme& method : schemes()) {
        if (!runs_on_opencl(method)) continue;
        CAPTURE(std::string(method.name));
        CAPTURE(width);
        const Preset preset = small(std::string(method.name));
        run(preset, width, is_implicit(method) ? 1 : 9);
      }
  }

  TEST_CASE("kernels in double, and without anything that can be left out") {
    if (skipped_without_oclgrind()) return;
    for (const int width : {1, 4}) {
      CAPTURE(width);
      Preset preset = small("verlet");
      preset.precision = Precision::double_;
      run(preset, width, 3);
      preset.k_b = preset.k_d = preset.F_max = 0, preset.W = {0, 0, 0}, preset.bodies.clear();
      run(preset, width, 9);
    }
  }

  TEST_CASE("kernels that write what is drawn, into buffers of just that size") {
    if (skipped_without_oclgrind()) return;
    const std::shared_ptr<opencl::Device> device = opencl::open_device(-1);
    opencl::VertexKernels kernels(device, false);
    const Lattice lattice{9, 37};
    constexpr int stride = 48;
    std::vector<float> x((std::size_t(lattice.rows) + 5) * 3 * stride + 32);
    for (std::size_t n = 0; n < x.size(); ++n) x[n] = float(n % 89) - 44;
    const opencl::Memory from = device->zeros(x.size() * sizeof(float));
    opencl::check(clEnqueueWriteBuffer(device->queue(), from.get(), CL_TRUE, 0, x.size() * sizeof(float), x.data(), 0,
                                       nullptr, nullptr),
                  "writing to the device");
    kernels.set_tears(std::array<TornSite, 3>{{{0, 64}, {38, 255}, {5, 0}}});
    for (const int every : {1, 4}) {
      const DrawnSites sites{lattice, every};
      const std::size_t bytes = 3 * sizeof(float) * std::size_t(sites.rows()) * std::size_t(sites.columns());
      const opencl::Memory positions = device->zeros(bytes), normals = device->zeros(bytes);
      kernels.write_positions(from.get(), stride, sites, positions.get());
      if (every == 1) kernels.write_normals(positions.get(), sites, normals.get());
      const VertexBox box = kernels.box();
      CHECK(box.lo.x == doctest::Approx(-44).epsilon(0.1));
      CHECK(box.hi.x == doctest::Approx(44).epsilon(0.1));
    }
  }
}

}  // namespace tyglab::opencl_checked_test

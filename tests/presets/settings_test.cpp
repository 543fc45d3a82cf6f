// --set KEY=VALUE.
#include <doctest/doctest.h>

#include "core/io/preset_io.h"

namespace tyglab::settings_test {

Preset with_bodies() {
  Preset preset;
  preset.bodies.resize(2);
  preset.bodies[1].shape = Body::Shape::plane;
  return preset;
}

TEST_CASE("every form of --set") {
  const Preset base = with_bodies();
  const auto set = [&](std::vector<std::string> settings) { return with_settings(base, settings); };
  CHECK(set({}) == base);
  CHECK(set({"k_s=500"}).k_s == 500);
  CHECK(set({"k_s=5e2"}).k_s == 500);
  CHECK(set({"rows=64"}).rows == 64);
  CHECK(set({"W=[0,0,0.02]"}).W == glm::dvec3(0, 0, 0.02));
  CHECK(set({"W=[0, 0, -1e-3]"}).W == glm::dvec3(0, 0, -1e-3));
  CHECK(set({"bodies[0].r=0.3"}).bodies[0].r == 0.3);
  CHECK(set({"bodies[1].y=-0.5"}).bodies[1].y == -0.5);
  CHECK(set({"bodies[0].c=[1,2,3]"}).bodies[0].c == glm::dvec3(1, 2, 3));
  CHECK(set({"bodies[0].shape=plane"}).bodies[0].shape == Body::Shape::plane);
  CHECK(set({"bodies[0].y=1", "bodies[0].shape=plane"}).bodies[0].y == 1);
  CHECK(set({"bodies[0].shape=plane"}).bodies[0].r == Body().r);  // which a plane has not
  CHECK(set({"bodies=[]"}).bodies.empty());
  CHECK(set({"bodies=[{\"shape\": \"plane\", \"y\": 1}]"}).bodies[0].y == 1);
  CHECK(set({"integrator=euler"}).integrator == "euler");
  CHECK(set({"integrator=\"euler\""}).integrator == "euler");
  CHECK(set({"precision=double"}).precision == Precision::double_);
  CHECK(set({"engine=opencl"}).engine == EngineKind::opencl);
  CHECK(set({"pins=none"}).pins.mode == Pins::Mode::none);
  CHECK(set({"pins=[[0,0],[3,4]]"}).pins.list.size() == 2);
  CHECK(set({"texture=linen.png"}).texture == "linen.png");
  CHECK(set({"name=A new name"}).name == "A new name");
  CHECK(set({"name=3 sheets"}).name == "3 sheets");
  CHECK(set({"texture=2.png"}).texture == "2.png");
  CHECK(set({"name=täcke"}).name == "täcke");
  CHECK(set({"kind=one_weight"}).kind == Kind::one_weight);
  CHECK(set({"k_s=1", "k_b=2", "k_s=3"}).k_s == 3);
}

TEST_CASE("settings are judged together, in any order") {
  CHECK(with_settings({}, {"pins=[[60,0]]", "rows=64"}).rows == 64);
  CHECK_THROWS_AS(with_settings({}, {"pins=[[20,0]]", "rows=10"}), PresetError);
}

TEST_CASE("a wrong setting is refused by its name and leaves the preset as it was") {
  const Preset base = with_bodies();
  for (const char* setting : {"",
                              "=",
                              "k_s",
                              "=5",
                              "k_s=",
                              "k_s=abc",
                              "k_s=-1",
                              "k_s=NaN",
                              "k_s=nan",
                              "k_s=Infinity",
                              "k_s=inf",
                              "k_s=1e999",
                              "k_s=[1]",
                              "k_s=1 2",
                              "k_s=1;rm",
                              "rows=2.5",
                              "rows=1",
                              "rows=5000",
                              "W=5",
                              "W=[1,2]",
                              "W=[1,2,3,4]",
                              "W=1,2,3",
                              "W=[1,2,nan]",
                              "bodies[2].r=0.3",
                              "bodies[-1].r=0.3",
                              "bodies[99999999999999999999].r=0.3",
                              "bodies[x].r=0.3",
                              "bodies[0]=5",
                              "bodies[0].=5",
                              "bodies[0].q=5",
                              "bodies[0].y=1",    // a sphere
                              "bodies[1].r=0.3",  // a plane
                              "bodies.r=5",
                              "bodies[0.r=5",
                              "bodies[0].r=0",
                              "unknown=5",
                              "forces=5",
                              "cloth={}",
                              "integrator=magic",
                              "precision=half",
                              "pins=left",
                              "pins=[[99,0]]",
                              "tyglab_preset=1",
                              "K_S=5",
                              " k_s=5",
                              "mode=0",
                              "dt=0",
                              "x_0.w=1",
                              "name=a\xff"}) {
    CAPTURE(std::string(setting));
    try {
      with_settings(base, {"k_b=1", setting});
      FAIL_CHECK("accepted: " << setting);
    } catch (const PresetError& error) {
      CHECK(std::string(error.what()).find("--set") != std::string::npos);
    }
  }
}

TEST_CASE("numbers that are too large or too small are told so, with their key") {
  for (const auto& [setting, says] : std::initializer_list<std::pair<const char*, const char*>>{
           {"k_s=1e999", "--set k_s=1e999: k_s: '1e999' is too large or too small for a number"},
           {"forces.k_s=-1e999", "forces.k_s: '-1e999' is too large or too small"},
           {"bodies[0].r=1e999", "bodies[0].r: '1e999' is too large or too small"},
           {"W=[0,1e999,0]", "--set W=[0,1e999,0]: column 4: [1]: 1e999 is too large for a number"}}) {
    CAPTURE(std::string(setting));
    try {
      with_settings(with_bodies(), {setting});
      FAIL_CHECK("accepted");
    } catch (const PresetError& error) {
      CHECK_MESSAGE(std::string(error.what()).find(says) != std::string::npos, error.what());
    }
  }
}

TEST_CASE("a misspelt key of --set gets the nearest known one") {
  const auto error_of = [](const char* setting) -> std::string {
    try {
      with_settings({}, {setting});
    } catch (const PresetError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(error_of("coloumns=5").find("did you mean columns") != std::string::npos);
  CHECK(error_of("intergrator=euler").find("did you mean integrator") != std::string::npos);
  CHECK(error_of("integrator=eular").find("did you mean euler") != std::string::npos);
  CHECK(error_of("k_s=-4").find("k_s") != std::string::npos);
  CHECK(error_of("e=1").find("e: unknown key; known: ") != std::string::npos);
  CHECK(error_of("cloth.k_s=5").ends_with("k_s belongs to \"forces\""));
  for (const char* of_a_fabric : {"fabric.mass=200", "fabric={}"})
    CHECK(error_of(of_a_fabric).ends_with("stands only in files; set m, B, k_warp, k_weft and k_shear"));
}

}  // namespace tyglab::settings_test

// SPDX-License-Identifier: MIT
// The speed of light of the technique `izb`: the tests that the walk makes, all of them and no others, give the frame's
// mask.
#include <fmt/format.h>

#include <cstdlib>

#include "base/error.h"
#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"
#include "shadow/izb/izb.h"

namespace izb::test {
namespace {

constexpr int width_px = 64, height_px = 48;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));

struct Prepared {
  Izb technique;
  Renderer renderer;
  gpu::StageTimers timers{true};

  Prepared(const Scene& scene, const std::vector<Light>& lights, const Settings& settings)
      : renderer(scene, capabilities()) {
    set_options(technique, with({{"grid", "64"}}, settings));
    renderer.prepare(technique, width_px, height_px, lights);
    renderer.render(camera, lights, timers);
  }

  uint64_t count(const std::string& name, size_t light = 0) {
    for (const auto& [key, value] : renderer.count(light))
      if (key == name) return value;
    ADD_FAILURE() << "no count " << name;
    return 0;
  }
  std::string error() {
    try {
      renderer.speed_of_light(0, 1);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
};

void expect_same(Prepared& p, size_t light, bool removal, const std::string& what) {
  const std::vector<uint32_t> mask = p.renderer.read_mask(light);
  const SpeedOfLight found = p.renderer.speed_of_light(light, 2).value();
  EXPECT_TRUE(found.same_mask) << what;
  EXPECT_EQ(found.ms.size(), 2u) << what;
  EXPECT_EQ(p.renderer.read_mask(light), mask) << what;
  EXPECT_GT(found.tests, 3000u) << what;
  EXPECT_GT(std::count(mask.begin(), mask.end(), 0xffffffffu), 50) << what;
  const uint64_t counted = p.count("visibility_tests", light);
  if (removal)
    EXPECT_NEAR(double(found.tests), double(counted), 0.1 * double(counted)) << what;
  else
    EXPECT_EQ(found.tests, counted) << what;
}

TEST(SpeedOfLight, MakesTheTestsOfTheWalk) {
  const Scene scenes[] = {tangle(80, 300), masked_tangle(3)};
  const std::vector<Light> lights{sun(130, 35), point_light({0.5, 2.5, 0.4}), spot({1, 5, 2}, {0, 0, 0}, 55)};
  struct Case {
    size_t scene;
    const char* spp;
    bool removal;
  };
  // Each value with each other value once: what takes time is compiling the programs of all of them.
  for (const auto& [n, spp, removal] : {Case{0, "32", true}, {1, "32", false}, {0, "1", false}, {1, "1", true}}) {
    const Settings more{{"cascades", "4"}, {"cascade-pass", "multiple"}, {"removal", "off"}};
    Prepared p(scenes[n], lights, removal ? Settings{{"spp", spp}} : with({{"spp", spp}}, more));
    for (size_t light = 0; light < lights.size(); ++light)
      expect_same(p, light, removal, fmt::format("scene {} spp {} removal {} light {}", n, spp, removal, light));
  }
}

TEST(SpeedOfLight, FollowsTheOptions) {
  const Scene scene = masked_tangle(5);
  // Several at once, since compiling takes the time.
  const Settings each[] = {{{"alpha", "fragment"}, {"lut", "32"}, {"zcull", "off"}},
                           {{"insertion", "exact"}, {"coverage", "exact"}, {"pipelining", "on"}, {"occluders", "on"}},
                           {{"alpha", "off"}, {"unchanged-skip", "off"}, {"nl-cull", "off"}}};
  for (const Settings& settings : each) {
    Prepared p(scene, {sun(130, 35)}, with({{"spp", "32"}, {"removal", "off"}}, settings));
    expect_same(p, 0, false, testing::PrintToString(settings));
  }
  if (!HardwareRaster::missing(capabilities(), 1.0).empty()) return;
  Prepared p(scene, {sun(130, 35)}, {{"spp", "32"}, {"removal", "off"}, {"raster", "hw"}});
  expect_same(p, 0, false, "raster hw");
}

// Far casters are where single precision decides least.
TEST(SpeedOfLight, SettlesWhatSinglePrecisionLeaves) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f, 3));
  std::vector<glm::vec3> roof = floor_of(8.0f, 40);
  for (glm::vec3& p : roof) p.y = 3000.0f;
  add_soup(scene, roof);
  for (const Settings& settings : {Settings{{"spp", "1"}}, {{"spp", "32"}}, {{"spp", "32"}, {"coverage", "exact"}}}) {
    Prepared p(scene, {sun(0, 90)}, with(settings, {{"pairs", "65536"}}));
    EXPECT_GT(p.count("pairs_in_double"), 100u);
    expect_same(p, 0, true, testing::PrintToString(settings));
  }
}

TEST(SpeedOfLight, OfNoTestIsNone) {
  Scene scene = empty_scene();
  add_soup(scene, {{50, 0, 50}, {51, 0, 50}, {50, 0, 51}});  // beside the picture
  Prepared p(scene, {sun(130, 35)}, {{"spp", "32"}});
  const SpeedOfLight found = p.renderer.speed_of_light(0, 1).value();
  EXPECT_EQ(found.tests, 0u);
  EXPECT_TRUE(found.same_mask);
}

TEST(SpeedOfLight, IsRefusedWithoutRoom) {
  const Scene scene = tangle(80, 300);
  Prepared p(scene, {sun(130, 35)}, {{"spp", "32"}});
  setenv("IZB_MEMORY_BYTES", "100000", 1);
  const std::string sentence = p.error();
  unsetenv("IZB_MEMORY_BYTES");
  EXPECT_NE(sentence.find("not enough memory"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("speed of light"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("--size"), std::string::npos) << sentence;
}

TEST(SpeedOfLight, IsRefusedWhereThePairsInDoubleAreNotListed) {
  const Scene scene = tangle(80, 300);
  Prepared p(scene, {sun(130, 35)}, {{"spp", "32"}, {"pairs", "0"}});
  ASSERT_GT(p.count("pairs_in_double"), 0u);
  const std::string sentence = p.error();
  EXPECT_NE(sentence.find("--pairs 0"), std::string::npos) << sentence;
}

TEST(SpeedOfLight, OfATechniqueWithoutTestsIsNothing) {
  const Scene scene = tangle(80, 30);
  const auto technique = make_technique("ray_traced");
  if (!technique->missing(capabilities()).empty()) GTEST_SKIP() << "this build has no Embree";
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, {sun(130, 35)});
  gpu::StageTimers timers(true);
  renderer.render(camera, {sun(130, 35)}, timers);
  EXPECT_FALSE(renderer.speed_of_light(0, 1).has_value());
}

TEST(StoredTests, KeepTheirNumbers) {
  const int far = shared::largest_picture_px - 1;
  for (const glm::ivec2 px : {glm::ivec2(0, 0), glm::ivec2(far, 0), glm::ivec2(0, far), glm::ivec2(1234, 5678)})
    for (const uint32_t instance : {0u, 1u, 0xffffu, 0x10000u, shared::storable_instances - 1u})
      for (const uint32_t triangle : {0u, 7u, shared::storable_triangles - 1u}) {
        const glm::uvec2 id(instance + 1u, triangle), words = shared::stored_test(px, id);
        EXPECT_TRUE(shared::is_storable(id));
        EXPECT_EQ(shared::stored_pixel(words), px);
        EXPECT_EQ(shared::stored_id(words), id);
      }
  EXPECT_FALSE(shared::is_storable({shared::storable_instances + 1u, 0u}));
  EXPECT_FALSE(shared::is_storable({1u, shared::storable_triangles}));
  EXPECT_LE(largest_part_triangles, shared::storable_triangles);
}

}  // namespace
}  // namespace izb::test

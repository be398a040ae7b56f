// SPDX-License-Identifier: MIT
// Where the technique `izb` does its work: by pixel and by texel, against its own sums and the lists.
#include <fmt/format.h>

#include "gl/edge_on_wall.h"
#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"
#include "shadow/izb/izb.h"

namespace izb::test {
namespace {

constexpr int width_px = 64, height_px = 48;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));

struct Work {
  Izb technique;
  Renderer renderer;
  Frame frame;
  std::vector<float> tests, fragments;

  Work(const Scene& scene, const Light& light, const Settings& settings) : renderer(scene, capabilities()) {
    set_options(technique, settings);
    renderer.prepare(technique, width_px, height_px, {light});
    frame = render_frame(renderer, technique, camera, light);
    tests = renderer.tests_a_pixel();
    EXPECT_EQ(renderer.read_mask(), frame.mask);
    fragments = renderer.fragments_a_texel();
    EXPECT_EQ(renderer.read_mask(), frame.mask);
  }
};

// Removal makes the tests of 32 samples depend on the order of fragments, so that no two frames need have the same.
TEST(Work, AddsUpToTheCounts) {
  const Scene scenes[] = {tangle(80, 300), masked_tangle(3)};
  for (size_t s = 0; s < 2; ++s)
    for (const Light& light : {sun(130, 35), point_light({0.5, 2.5, 0.4})})
      for (const char* spp : {"1", "32"})
        for (const char* cascades : {"1", "4"}) {
          Settings settings{{"spp", spp}, {"cascades", cascades}, {"grid", "64"}, {"removal", "off"}};
          if (s == 1 && *cascades == '4') settings.emplace_back("alpha", "fragment");
          if (*cascades == '4') settings.emplace_back("cascade-pass", "multiple");
          const Work work(scenes[s], light, settings);
          const std::string what =
              fmt::format("scene {} light {} spp {} cascades {}", s, type_name(light.type), spp, cascades);
          EXPECT_EQ(work.tests.size(), size_t{width_px * height_px}) << what;
          EXPECT_EQ(sum_of(work.tests), work.frame.count("visibility_tests")) << what;
          EXPECT_EQ(sum_of(work.fragments), work.frame.count("fragments_after_zcull")) << what;
          EXPECT_GT(sum_of(work.tests), 3000u) << what;
          const IzbInternals built = work.technique.internals();
          EXPECT_EQ(work.fragments.size(), size_t(built.grid) * built.grid * built.layers) << what;
          // Each fragment walks the whole list of its texel.
          std::vector<float> walked(work.tests.size(), 0.0f);
          for (size_t texel = 0; texel < built.lists.count(); ++texel)
            for (const uint32_t node : built.lists[texel]) {
              const glm::ivec2 px = shared::pixel_from_node(node);
              walked[size_t(px.y) * width_px + size_t(px.x)] += work.fragments[texel];
            }
          EXPECT_EQ(walked, work.tests) << what;
        }
}

TEST(Work, OfOneSampleAddsUpWithRemovalToo) {
  const Work work(tangle(80, 300), sun(130, 35), {{"grid", "64"}});
  // On a GPU a list's walks meet others' removals at another moment each time: seen, 1 % apart.
  const double tests = double(work.frame.count("visibility_tests"));
  EXPECT_NEAR(double(sum_of(work.tests)), tests, capabilities().software ? 0.0 : 0.05 * tests);
  EXPECT_EQ(sum_of(work.fragments), work.frame.count("fragments_after_zcull"));
  EXPECT_GT(work.frame.count("nodes_removed"), 100u);
}

TEST(Work, WithoutZCullIsThatOfAllFragments) {
  const Work work(tangle(80, 300), sun(130, 35), {{"grid", "64"}, {"zcull", "off"}, {"spp", "32"}});
  EXPECT_EQ(sum_of(work.fragments), work.frame.count("fragments"));
}

// The floor's micro-quads must not pay for those of the wall.
TEST(Work, OfAMicroQuadThatNearlyReachesTheLightIsItsOwn) {
  const EdgeOnWall wall = edge_on_wall({4.0f, 5.0f, 7.0f}, {0.0f, 0.6f, 0.0f});
  const auto nodes = [&](const Scene& scene) {
    const Work work(scene, wall.lamp, {{"insertion", "exact"}, {"spp", "32"}});
    return double(work.frame.count("nodes")) / double(receivers(work.frame));
  };
  EXPECT_LT(nodes(wall.with_wall), 1.2 * nodes(wall.floor));  // 9.0 and 8.7; with one guard for all 17.0
}

TEST(Work, OfATechniqueWithoutListsIsNone) {
  const Scene scene = tangle(80, 30);
  const auto technique = make_technique("ray_traced");
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, {sun(130, 35)});
  gpu::StageTimers timers(true);
  renderer.render(camera, {sun(130, 35)}, timers);
  EXPECT_TRUE(renderer.tests_a_pixel().empty());
  EXPECT_TRUE(renderer.fragments_a_texel().empty());
}

}  // namespace
}  // namespace izb::test

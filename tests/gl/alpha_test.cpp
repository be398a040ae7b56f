// SPDX-License-Identifier: MIT
// Alpha-masked casters and receivers on small frames: against all pairs of triangle, pixel and sample on the CPU,
// against rays, and against themselves with every option changed.
#include <bit>

#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"
#include "reference/points.h"

namespace izb::test {
namespace {

constexpr int width_px = 48, height_px = 36;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}};

size_t bits(const std::vector<uint32_t>& mask) {
  size_t sum = 0;
  for (const uint32_t word : mask) sum += static_cast<size_t>(std::popcount(word));
  return sum;
}

void expect_right_points(const Frame& frame, const Camera& its) {
  const reference::RayTracer tracer(frame.triangles);
  const reference::PointCheck check = reference::check_points(
      tracer, frame.triangles, reference::pixel_rays(its, frame.gbuffer.width_px, frame.gbuffer.height_px),
      frame.receivers);
  EXPECT_EQ(check.wrong, 0u);
  EXPECT_LT(check.near_cutoff, 3u);
}

TEST(Alpha, IsTheBruteForceMaskAtOneSample) {
  const Scene scene = masked_tangle(90);
  for (const Light& light : {sun(130, 35), spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40), point_light({0.5, 1.0, 0.5})}) {
    const Frame frame = render_frame(scene, camera, light, 4 * width_px, 4 * height_px);
    EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u);
    EXPECT_GT(shadowed(frame), 500u);
    EXPECT_EQ(expect_explained(frame).explained_by_alpha, 0u);
    expect_right_points(frame, camera);
    const Frame opaque = render_frame(scene, camera, light, 4 * width_px, 4 * height_px, {{"alpha", "off"}});
    EXPECT_GT(shadowed(opaque), shadowed(frame) + 200);  // or the masks cut nothing
  }
}

TEST(Alpha, IsTheBruteForceMaskAt32Samples) {
  const Scene scene = masked_tangle(91);
  const Camera grazing = look_at({5.5, 0.12, 3.0}, {-3, 0.1, 0}, glm::radians(50.0));
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 4.0;
  flat.near_plane = 0.1;
  flat.far_plane = 40.0;
  const std::pair<const Camera*, Light> cases[] = {{&grazing, sun(40, 8)},
                                                   {&flat, spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40)}};
  for (const auto& [its, light] : cases) {
    const Frame frame = render_frame(scene, *its, light, width_px, height_px, with(exact, {{"grid", "256"}}));
    EXPECT_EQ(different(frame.mask, brute_force_words(frame)), 0u);
    EXPECT_GT(bits(frame.mask), 1000u);
    expect_explained(frame);
    expect_right_points(frame, *its);
  }
}

TEST(Alpha, TheExactMaskDependsOnNoOption) {
  const Scene scene = masked_tangle(92);
  const Settings variants[] = {
      {{"cascades", "8"}, {"cascade-pass", "multiple"}, {"grid", "256"}, {"zcull", "off"}},
      {{"removal", "off"}, {"unchanged-skip", "off"}, {"pipelining", "on"}, {"cascades", "3"}, {"grid", "512"}},
      {{"pairs", "0"}, {"grid", "64"}},
      {{"unchanged-skip", "off"}, {"zcull-pyramid", "off"}}};
  for (const Settings& settings : {exact, Settings{{"spp", "1"}}}) {
    const Frame base = render_frame(scene, camera, sun(130, 35), width_px, height_px, settings);
    for (const Settings& variant : variants) {
      const Frame other = render_frame(scene, camera, sun(130, 35), width_px, height_px, with(settings, variant));
      EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].first << " " << variant[0].second;
    }
  }
}

// With the table only lines cost bits, the masks cost none.
TEST(Alpha, TheTableErrsAsLittleAsWithoutMasks) {
  const Scene scene = masked_tangle(93);
  const Frame truth = render_frame(scene, camera, sun(130, 35), width_px, height_px, exact);
  const Frame frame =
      render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"spp", "32"}, {"insertion", "exact"}});
  size_t wrong = 0;
  for (size_t i = 0; i < frame.mask.size(); ++i)
    wrong += static_cast<size_t>(std::popcount(frame.mask[i] ^ truth.mask[i]));
  EXPECT_GT(wrong, 0u);
  EXPECT_LT(wrong, bits(truth.mask) / 20);
}

TEST(Alpha, RaysAgree) {
  const Scene scene = masked_tangle(94);
  const Light light = point_light({0.5, 3.0, 0.5});
  const Frame ours = render_frame(scene, camera, light, width_px, height_px, exact);
  const Frame rays = render_frame(scene, camera, light, width_px, height_px, {{"spp", "32"}}, "ray_traced");
  size_t wrong = 0;
  for (size_t i = 0; i < ours.mask.size(); ++i)
    wrong += static_cast<size_t>(std::popcount(ours.mask[i] ^ rays.mask[i]));
  EXPECT_LT(wrong, 30u);
  EXPECT_GT(bits(ours.mask), 1000u);
}

// As far from the exact mask as texels are from samples, but neither opaque nor empty.
TEST(Alpha, OnceAFragmentIsNearTheExactMask) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(8.0f));
  add_soup(scene, rectangle({-2, 2, -2}, {0, 0, 4}, {4, 0, 0}));
  mask_mesh(scene, 1, 95, blots(95, 8, 8, Wrap::repeat, Wrap::repeat, false));
  scene.meshes[1].uvs = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
  for (const Light& light : {sun(130, 55), point_light({0.3, 5.0, 0.2}), spot({0.3, 5.0, 0.2}, {0, 0, 0}, 50)}) {
    const auto render = [&](const char* alpha) {
      return render_frame(scene, camera, light, 4 * width_px, 4 * height_px, {{"alpha", alpha}, {"grid", "1024"}});
    };
    const Frame fragment = render("fragment"), whole = render("exact"), off = render("off");
    const size_t wrong = different(fragment.mask, whole.mask);
    EXPECT_GT(wrong, 0u);
    EXPECT_LT(10 * wrong, shadowed(whole));
    EXPECT_GT(shadowed(off), shadowed(whole) + shadowed(whole) / 4);
  }
}

// llvmpipe ends all loops of an invocation after 65,535 rounds: the samples' alpha takes at most eight of a test's.
TEST(Alpha, AListOfThousandsIsWalkedToItsEnd) {
  const Scene scene = masked_tangle(96);
  const auto render = [&](const char* grid) {
    return render_frame(scene, camera, sun(130, 35), 320, 240,
                        with(exact, {{"grid", grid}, {"zcull", "off"}, {"removal", "off"}, {"unchanged-skip", "off"}}));
  };
  const Frame coarse = render("16"), fine = render("512");
  EXPECT_GT(coarse.count("longest_list"), 1000u);
  EXPECT_EQ(different(coarse.mask, fine.mask), 0u);
}

TEST(Alpha, MaskedMaterialsWithoutTextureAreThereOrNot) {
  for (const float alpha : {0.5f, 0.49f}) {
    Scene scene = empty_scene();
    add_soup(scene, floor_of(8.0f));
    add_soup(scene, rectangle({-1, 2, -1}, {0, 0, 2}, {2, 0, 0}));
    Material material;
    material.alpha_mode = AlphaMode::mask;
    material.base_color.a = alpha;
    scene.materials.push_back(material);
    scene.meshes[1].material = 1;
    const Frame frame = render_frame(scene, camera, sun(130, 55), width_px, height_px);
    EXPECT_EQ(shadowed(frame) > 0, alpha >= 0.5f);
    EXPECT_EQ(std::count_if(frame.gbuffer.id.begin(), frame.gbuffer.id.end(), [](auto id) { return id.x == 2; }) > 0,
              alpha >= 0.5f);
    expect_right_points(frame, camera);
    EXPECT_EQ(expect_explained(frame).disputed, 0u);
  }
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// The technique `izb` at 32 samples a pixel, against all pairs of triangle, pixel and sample on the CPU, and against
// itself with every option changed.
#include <bit>
#include <numeric>

#include "base/error.h"
#include "gl/frame_fixture.h"
#include "shared/coverage.h"
#include "shared/lists.h"

namespace izb::test {
namespace {

constexpr int width_px = 48, height_px = 36;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}};

size_t partly(const Frame& frame) {
  return static_cast<size_t>(
      std::count_if(frame.mask.begin(), frame.mask.end(), [](uint32_t word) { return word != 0u && word != ~0u; }));
}

size_t bits(const std::vector<uint32_t>& mask) {
  return std::accumulate(mask.begin(), mask.end(), size_t{0},
                         [](size_t sum, uint32_t word) { return sum + size_t(std::popcount(word)); });
}

// Few frames a test: a software renderer takes seconds to compile the exact test.
TEST(Izb32, IsTheBruteForceMask) {
  const Scene scene = tangle(80, 300);
  const Camera grazing = look_at({5.5, 0.12, 3.0}, {-3, 0.1, 0}, glm::radians(50.0));
  const Frame frame = render_frame(scene, grazing, sun(40, 4), width_px, height_px, exact);
  EXPECT_EQ(different(frame.mask, brute_force_words(frame)), 0u);
  EXPECT_GT(partly(frame), 100u);
  expect_explained(frame);
}

TEST(Izb32, IsTheBruteForceMaskOfAnOrthographicCameraAndASpot) {
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 4.0;
  flat.near_plane = 0.1;
  flat.far_plane = 40.0;
  const Light light = spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40);
  const Frame frame = render_frame(tangle(80, 300), flat, light, width_px, height_px, with(exact, {{"grid", "256"}}));
  EXPECT_EQ(different(frame.mask, brute_force_words(frame)), 0u);
  EXPECT_GT(partly(frame), 100u);
  expect_explained(frame);
}

TEST(Izb32, TheExactMaskDependsOnNoOption) {
  const Scene scene = tangle(81, 300);
  const Settings variants[] = {
      {{"cascades", "8"}, {"cascade-pass", "multiple"}, {"grid", "256"}, {"zcull", "off"}},
      {{"removal", "off"}, {"unchanged-skip", "off"}, {"pipelining", "on"}, {"cascades", "3"}, {"grid", "512"}},
      {{"pairs", "0"}}};
  const Frame base = render_frame(scene, camera, sun(130, 35), width_px, height_px, exact);
  EXPECT_GT(base.count("pairs_in_double"), 500u);  // or `pairs` decides nothing
  for (const Settings& variant : variants) {
    const Frame other = render_frame(scene, camera, sun(130, 35), width_px, height_px, with(exact, variant));
    EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].first << " " << variant[0].second;
  }
}

// llvmpipe ends all loops of an invocation after 65,535 rounds: none may be spent on samples.
TEST(Izb32, AListOfThousandsIsWalkedToItsEnd) {
  const Scene scene = tangle(81, 60);
  const Settings one_list{{"grid", "16"}, {"zcull", "off"}};
  const Frame frame = render_frame(scene, camera, sun(130, 35), 480, 360, with(exact, one_list));
  EXPECT_GT(frame.count("longest_list"), 2500u);
  const Frame fine = render_frame(scene, camera, sun(130, 35), 480, 360, with(exact, {{"grid", "512"}}));
  EXPECT_LT(fine.count("longest_list"), 400u);
  EXPECT_EQ(different(frame.mask, fine.mask), 0u);
}

TEST(Izb32, AListBeyondTheDriversLoopsIsANamedRefusal) {
  if (!capabilities().software) GTEST_SKIP() << "other drivers' loops end by themselves";
  Scene scene = empty_scene();
  add_soup(scene, floor_of(0.2f));  // three quarters of the picture, and one texel of the grid
  add_soup(scene, rectangle({-0.02f, 0.05f, -0.02f}, {0, 0, 0.04f}, {0.04f, 0, 0}));
  add_soup(scene, rectangle({150, -300, -20}, {0, 0, 40}, {25, 0, 0}));
  Camera above = look_at({0.0, 0.2, 0.0}, {0, 0, 0.0001}, glm::radians(60.0));
  above.far_plane = 1000.0;
  for (const char* spp : {"1", "32"}) try {
      render_frame(scene, above, sun(10, 88), 360, 360, {{"grid", "16"}, {"spp", spp}});
      ADD_FAILURE() << "no refusal";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("longer than this driver's loops"), std::string::npos) << e.what();
    }
}

// llvmpipe's limit of loops again: the texels of one micro-quad take several dispatches.
TEST(Izb32, AMicroQuadMayTouchAnyNumberOfTexels) {
  const auto render = [](const char* grid) {
    return render_frame(tangle(81, 300), look_at({0, 9, 0.1}, {0, 0, 0}, glm::radians(40.0)), sun(130, 65), 2, 2,
                        with(exact, {{"grid", grid}, {"grid-density", "0"}}));
  };
  const Frame fine = render("1024"), coarse = render("16");
  EXPECT_GT(fine.count("nodes"), uint64_t{2 * 2 * 2} * shared::texels_a_dispatch);  // three dispatches
  EXPECT_EQ(different(fine.mask, coarse.mask), 0u);
  EXPECT_EQ(different(fine.mask, brute_force_words(fine)), 0u);
  EXPECT_GT(partly(fine), 2u);
}

// Where a window holds few receivers for its grid, fewer and larger texels meet fewer triangles.
TEST(Izb32, ADensityLimitSavesWorkAndChangesNoExactMask) {
  const Scene scene = tangle(81, 300);
  const Settings fine = with(exact, {{"cascades", "3"}, {"grid", "512"}, {"grid-density", "0"}});
  const Frame all = render_frame(scene, camera, sun(130, 35), width_px, height_px, fine);
  const Frame limited =
      render_frame(scene, camera, sun(130, 35), width_px, height_px, with(fine, {{"grid-density", "4"}}));
  EXPECT_EQ(different(all.mask, limited.mask), 0u);
  EXPECT_LT(limited.count("fragments_after_zcull"), all.count("fragments_after_zcull") / 4);
  EXPECT_LT(limited.count("nodes"), all.count("nodes") / 4);
  for (size_t i = 0; i < limited.windows.size(); ++i) {
    EXPECT_LT(shared::last_texel(limited.windows[i]), 140) << i;
    EXPECT_EQ(shared::last_texel(all.windows[i]), 511) << i;
  }
}

TEST(Izb32, OneSampleDependsOnNoOptionEither) {
  const Scene scene = tangle(82, 300);
  const Frame base = render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"spp", "1"}});
  for (const Settings& variant :
       {Settings{{"cascades", "4"}}, Settings{{"cascades", "3"}, {"cascade-pass", "multiple"}},
        Settings{{"removal", "off"}}, Settings{{"unchanged-skip", "off"}},
        Settings{{"pipelining", "on"}, {"removal", "off"}}}) {
    const Frame other = render_frame(scene, camera, sun(130, 35), width_px, height_px, with({{"spp", "1"}}, variant));
    EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].first << " " << variant[0].second;
  }
}

TEST(Izb32, ApproximationsWithoutChangeOfInsertionGiveOneMask) {
  const Scene scene = tangle(83, 300);
  const Settings approximate{{"spp", "32"}};
  const Frame base = render_frame(scene, camera, sun(130, 35), width_px, height_px, approximate);
  for (const Settings& variant :
       {Settings{{"removal", "off"}}, Settings{{"unchanged-skip", "off"}}, Settings{{"pipelining", "on"}},
        Settings{{"pairs", "0"}}, Settings{{"zcull-pyramid", "off"}}}) {
    const Frame other = render_frame(scene, camera, sun(130, 35), width_px, height_px, with(approximate, variant));
    EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].first << " " << variant[0].second;
  }
}

TEST(Izb32, TheTableErrsByFewBitsAndLessWhenItIsLarger) {
  const Scene scene = tangle(84, 300);
  const Frame truth = render_frame(scene, camera, sun(130, 35), width_px, height_px, exact);
  size_t before = 32 * truth.mask.size();
  for (const char* side : {"32", "128"}) {
    const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px,
                                     {{"spp", "32"}, {"insertion", "exact"}, {"lut", side}});
    size_t wrong = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i) wrong += size_t(std::popcount(frame.mask[i] ^ truth.mask[i]));
    EXPECT_LT(wrong, before);
    // Several edges cross a pixel here; the table alone errs by about half a bit an edge at 32 (facts measured
    // elsewhere).
    EXPECT_LT(wrong, 4 * partly(truth)) << side;
    before = wrong;
  }
}

TEST(Izb32, ApproximateInsertionOnlyLeaksAndMoreNodesLeakLess) {
  const Scene scene = tangle(85, 400);
  const Camera low = look_at({5.0, 0.7, 4.0}, {-1, 0, 0}, glm::radians(50.0));
  const Frame truth = render_frame(scene, low, sun(130, 35), width_px, height_px, exact);
  const auto leaks = [&](const Settings& more) {
    const Frame frame = render_frame(scene, low, sun(130, 35), width_px, height_px,
                                     with({{"spp", "32"}, {"coverage", "exact"}, {"grid", "256"}}, more));
    size_t leaked = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i) {
      EXPECT_EQ(frame.mask[i] & ~truth.mask[i], 0u) << "false shadow at " << i;
      leaked += size_t(std::popcount(truth.mask[i] & ~frame.mask[i]));
    }
    return leaked;
  };
  const size_t one = leaks({{"nodes", "1"}}), eight = leaks({{"nodes", "8"}}),
               samples = leaks({{"insertion", "samples"}});
  const size_t nv = leaks({{"insertion", "nv"}});
  EXPECT_GT(one, eight);
  EXPECT_LE(eight, nv);
  EXPECT_GT(one, samples);
  EXPECT_LT(eight, bits(truth.mask) / 50);
}

TEST(Izb32, RemovalAndSkippingSaveWork) {
  Scene scene = tangle(86, 50);
  // Many layers over the floor: most pixels are fully shadowed soon.
  for (int layer = 0; layer < 6; ++layer)
    add_soup(scene, rectangle({-6, 3.0f + 0.1f * float(layer), -6}, {0, 0, 12}, {12, 0, 0}));
  const Camera under = look_at({4.0, 2.0, 5.0}, {0, 0, 0}, glm::radians(50.0));
  const Settings neither{{"spp", "32"}, {"removal", "off"}, {"unchanged-skip", "off"}};
  const Frame base = render_frame(scene, under, sun(130, 60), width_px, height_px, neither);
  const Frame removal =
      render_frame(scene, under, sun(130, 60), width_px, height_px, with(neither, {{"removal", "on"}}));
  EXPECT_GT(removal.count("nodes_removed"), 500u);
  EXPECT_LT(removal.count("visibility_tests") * 2, base.count("visibility_tests"));
  const Frame skip =
      render_frame(scene, under, sun(130, 60), width_px, height_px, with(neither, {{"unchanged-skip", "on"}}));
  EXPECT_GT(skip.count("masks_unchanged"), 500u);
}

TEST(Izb32, FlatFloorsAndTheirDuplicatesHaveNoShadowedBit) {
  Scene scene = empty_scene();
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(1.0, 2.0, 0.5));
  add_soup(scene, floor_of(10.0f, 60), turned);
  add_soup(scene, floor_of(10.0f, 60), turned);
  add_soup(scene, floor_of(10.0f, 37), turned);
  for (const Light& light : {sun(130, 35), sun(20, 80)}) {
    const Frame frame = render_frame(scene, camera, light, 96, 72, exact);
    EXPECT_EQ(bits(frame.mask), 0u);
    EXPECT_GT(receivers(frame), 500u);
  }
}

TEST(Izb32, TheGBuffersMicroQuadIsTheSharedTexts) {
  const Scene scene = tangle(87, 200);
  const Frame frame =
      render_frame(scene, camera, sun(130, 35), width_px, height_px, with(exact, {{"micro-quad", "tangent"}}));
  for (size_t i = 0; i < frame.mask.size(); ++i) {
    if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
    const glm::vec3* v = &frame.triangles_vs[3 * frame.receivers.own_triangle[i]];
    const glm::vec4 seen = frame.gbuffer.micro_quad[i];
    const glm::vec4 made = shared::micro_quad_data(frame.inputs.camera, frame.gbuffer.center_px(i),
                                                   frame.gbuffer.eye_distance[i], v[0], v[1], v[2]);
    // GLSL lets a driver divide and take roots less exactly than C++: seen on NVIDIA, 2e-6 of an offset.
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(seen[k], made[k], 4e-6f * std::max(1.0f, std::abs(made[k]))) << i;
  }
}

}  // namespace
}  // namespace izb::test

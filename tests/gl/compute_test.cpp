// SPDX-License-Identifier: MIT
// --raster compute: the mask and the tests of the raster pipeline, with less work for it.
#include "base/error.h"
#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"
#include "shadow/izb/izb.h"

namespace izb::test {
namespace {

constexpr int width_px = 64, height_px = 48;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "128"}};
const Settings compute{{"raster", "compute"}};

std::vector<Light> lights() {
  return {sun(130, 35), spot({1, 5, 2}, {0, 0, 0}, 55), point_light({0.5, 2.5, 0.4})};
}

/// Nothing left to the raster pipeline, some of it, all of it.
void expect_brute_force(const Scene& scene, const Settings& settings) {
  Izb technique;
  set_options(technique, with(settings, compute));
  Renderer renderer(scene, capabilities());
  for (const Light& light : lights())
    for (const int texels : {1 << 28, 64, 0}) {
      technique.settings().compute_texels = texels;
      renderer.prepare(technique, width_px, height_px, {light});
      const Frame frame = render_frame(renderer, technique, camera, light);
      const bool many = frame.receivers.sample_count() == 32;
      EXPECT_EQ(different(frame.mask, many ? brute_force_words(frame) : brute_force_mask(frame)), 0u)
          << texels << " texels, " << type_name(light.type);
      EXPECT_GT(shadowed(frame), 100u);
    }
}

/// Room for few rows, or for few of the tiles in all rows.
IzbSettings with_little_room(IzbSettings settings, bool rows) {
  settings.rows_room = rows ? 40 : shared::rows_room;
  settings.tiles_room = rows ? shared::tiles_room : 40;
  return settings;
}

TEST(Compute, WritesTheBruteForceMaskAtOneSample) {
  expect_brute_force(masked_tangle(201), {{"grid", "256"}, {"compute-rounds", "4"}});
}

TEST(Compute, WritesTheBruteForceMaskAt32Samples) {
  expect_brute_force(masked_tangle(203), with(exact, {{"compute-rounds", "4"}}));
}

TEST(Compute, TheExactMaskDependsOnNoOption) {
  const Scene scene = tangle(204, 300);
  const Settings variants[] = {{{"raster", "gs"}},
                               {{"cascades", "4"}, {"cascade-pass", "multiple"}, {"zcull", "off"}},
                               {{"removal", "off"}, {"unchanged-skip", "off"}, {"pipelining", "on"}, {"cascades", "3"}},
                               {{"pairs", "0"}}};
  const Light light = point_light({0.5, 2.5, 0.4});
  const Frame base = render_frame(scene, camera, light, width_px, height_px, with(exact, compute));
  EXPECT_GT(base.count("pairs_in_double"), 100u);  // or `pairs` decides nothing
  for (const Settings& variant : variants) {
    const Frame other = render_frame(scene, camera, light, width_px, height_px, with(with(exact, compute), variant));
    EXPECT_EQ(different(base.mask, other.mask), 0u) << variant[0].first;
  }
}

TEST(Compute, AlphaOnceAFragmentIsThatOfTheGeometryShader) {
  const Scene scene = masked_tangle(205);
  for (const Light& light : lights()) {
    const Settings settings{{"alpha", "fragment"}, {"grid", "256"}};
    const Frame theirs = render_frame(scene, camera, light, width_px, height_px, settings);
    const Frame ours = render_frame(scene, camera, light, width_px, height_px, with(settings, compute));
    // A compiler may round where a texel's centre meets the triangle in two ways in two programs.
    EXPECT_LE(different(ours.mask, theirs.mask), capabilities().software ? 0u : 5u) << type_name(light.type);
  }
}

// llvmpipe ends all loops of an invocation after 65,535 rounds: such a triangle is left to fragments, with a limit
// each.
TEST(Compute, WhatALoopMayNotFinishIsLeftToFragments) {
  for (const bool masked : {false, true}) {
    Scene scene = masked ? masked_tangle(206) : tangle(206, 20);
    add_soup(scene, rectangle({-6, 6, -6}, {0, 0, 12}, {12, 0, 0}));  // over all of it
    if (masked) {
      mask_mesh(scene, scene.meshes.size() - 1, 207, blots(207, 8, 8, Wrap::repeat, Wrap::repeat, false));
    }
    const Settings few_lists =
        with(exact, {{"grid", "32"}, {"removal", "off"}, {"unchanged-skip", "off"}, {"occluders", "off"}});
    const Frame theirs = render_frame(scene, camera, sun(130, 80), 640, 480, few_lists);
    const Frame ours = render_frame(scene, camera, sun(130, 80), 640, 480, with(few_lists, compute));
    EXPECT_EQ(different(ours.mask, theirs.mask), 0u);
    if (capabilities().software) {
      EXPECT_GT(ours.count("triangles_drawn"), 0u) << "nothing came to the limit";
    }
  }
}

TEST(Compute, LeavesOnlyTheLargeTrianglesToTheRasterPipeline) {
  const Scene scene = tangle(208, 300);
  const auto counts = [&](const Settings& more) {
    return render_frame(scene, camera, sun(130, 35), width_px, height_px,
                        with({{"spp", "32"}, {"removal", "off"}, {"grid", "512"}}, more));
  };
  const Frame theirs = counts({}), all = counts(compute), none = counts(with(compute, {{"compute-texels", "0"}})),
              some = counts(with(compute, {{"compute-texels", "256"}}));
  const uint64_t triangles = theirs.count("triangles_after_zcull"), tests = theirs.count("visibility_tests");
  EXPECT_GT(triangles, 100u);
  EXPECT_EQ(none.count("triangles_after_zcull"), triangles);
  EXPECT_EQ(none.count("visibility_tests"), tests);
  EXPECT_EQ(none.count("triangles_drawn"), triangles);
  EXPECT_EQ(some.count("triangles_after_zcull"), triangles);
  EXPECT_GT(some.count("triangles_drawn"), 0u);
  EXPECT_LT(some.count("triangles_drawn"), none.count("triangles_drawn") / 2);
  EXPECT_EQ(all.count("triangles_after_zcull"), triangles);
  EXPECT_EQ(all.count("triangles_drawn"), 0u);
  // The same footprints and depths; but a rasteriser rounds depths to 16 bits, and corners to its own grid.
  EXPECT_GT(all.count("visibility_tests"), tests * 95 / 100);
  EXPECT_LT(all.count("visibility_tests"), tests * 105 / 100);
  const Frame unculled = counts(with(compute, {{"zcull", "off"}}));
  EXPECT_GT(unculled.count("visibility_tests"), tests * 12 / 10);
}

// A tile that nothing is swept in, or one that is swept twice, would not show in the mask of a tangle as surely.
TEST(Compute, TilesMeetTheTexelsOfTheirTriangleOnce) {
  Scene scene = tangle(214, 40);
  add_soup(scene, rectangle({-6, 6, -6}, {0, 0, 12}, {12, 0, 0}));
  for (const char* grid : {"100", "512"}) {  // no whole number of tiles, and one
    const Settings settings{{"spp", "32"},  {"removal", "off"},    {"unchanged-skip", "off"}, {"zcull", "off"},
                            {"grid", grid}, {"grid-density", "0"}, {"raster", "compute"}};
    Izb technique;
    set_options(technique, settings);
    Renderer renderer(scene, capabilities());
    renderer.prepare(technique, width_px, height_px, {sun(130, 80)});
    const Frame frame = render_frame(renderer, technique, camera, sun(130, 80));
    EXPECT_EQ(frame.count("triangles_drawn"), 0u);
    const std::vector<float> visits = renderer.fragments_a_texel();
    technique.settings().compute_texels = 0;
    renderer.prepare(technique, width_px, height_px, {sun(130, 80)});
    render_frame(renderer, technique, camera, sun(130, 80));
    const std::vector<float> drawn = renderer.fragments_a_texel();
    ASSERT_EQ(visits.size(), drawn.size());
    size_t other = 0, visited = 0;
    for (size_t i = 0; i < visits.size(); ++i) {
      other += visits[i] != drawn[i];
      visited += drawn[i] > 0;
    }
    EXPECT_GT(visited, 1000u) << grid;
    // A rasteriser rounds corners to its own grid: 5 of 8,243 texels, 11 of 214,570.
    EXPECT_LT(other, visited / 500) << grid;
  }
}

TEST(Compute, ASweepThatGoesOnInAnotherDispatchMakesTheSameTests) {
  for (const Scene& scene : {tangle(212, 300), masked_tangle(213)})
    for (const char* removal : {"off", "on"}) {
      const auto with_rounds = [&](const char* rounds) {
        const Settings settings = with(exact, {{"removal", removal}});
        return render_frame(scene, camera, sun(130, 35), width_px, height_px,
                            with(with(settings, compute), {{"compute-rounds", rounds}}));
      };
      const Frame in_one = with_rounds("0");
      EXPECT_GT(in_one.count("visibility_tests"), 4 * in_one.count("triangles_after_zcull")) << "or none goes on";
      for (const char* rounds : {"1", "3", "64"}) {
        SCOPED_TRACE(std::string(rounds) + " rounds, removal " + removal);
        const Frame frame = with_rounds(rounds);
        EXPECT_EQ(different(frame.mask, in_one.mask), 0u);
        EXPECT_EQ(frame.count("triangles_after_zcull"), in_one.count("triangles_after_zcull"));
        EXPECT_EQ(frame.count("triangles_drawn"), in_one.count("triangles_drawn"));
        EXPECT_EQ(frame.count("fragments_after_zcull"), in_one.count("fragments_after_zcull"));
        // With removal the order decides what is tested.
        if (removal == std::string("off")) {
          EXPECT_EQ(frame.count("visibility_tests"), in_one.count("visibility_tests"));
        }
      }
    }
}

TEST(Compute, WhatHasNoRoomInTheListIsDrawn) {
  for (const Scene& scene : {tangle(215, 300), masked_tangle(217)}) {
    Izb technique;
    set_options(technique, with(with(exact, compute), {{"grid", "512"}, {"grid-density", "0"}}));
    Renderer renderer(scene, capabilities());
    const Light light = sun(130, 35);
    renderer.prepare(technique, width_px, height_px, {light});
    const Frame whole = render_frame(renderer, technique, camera, light);
    EXPECT_EQ(whole.count("triangles_drawn"), 0u);
    for (const bool rows : {false, true}) {
      technique.settings() = with_little_room(technique.settings(), rows);
      renderer.prepare(technique, width_px, height_px, {light});
      const Frame frame = render_frame(renderer, technique, camera, light);
      EXPECT_EQ(different(frame.mask, whole.mask), 0u) << rows;
      EXPECT_GT(frame.count("triangles_drawn"), 0u) << rows;
      EXPECT_EQ(frame.count("triangles_after_zcull"), whole.count("triangles_after_zcull")) << rows;
      EXPECT_LE(frame.count("triangles_drawn"), whole.count("triangles_after_zcull"))
          << rows << ": once for all of a triangle's rows";
    }
  }
}

// Room for the tiles that the pyramid leaves is too little without it.
TEST(Compute, TilesThatNoReceiverLiesBehindAreNotListed) {
  Scene scene = tangle(218, 40);
  add_soup(scene, rectangle({-6, -3, -6}, {0, 0, 12}, {12, 9, 0}));  // from below the ground to above it
  Izb technique;
  for (const char* pyramid : {"on", "off"}) {
    set_options(technique, {{"spp", "32"}, {"grid", "512"}, {"grid-density", "0"}, {"raster", "compute"}});
    set_options(technique, {{"zcull-pyramid", pyramid}});
    technique.settings().tiles_room = 3000;
    Renderer renderer(scene, capabilities());
    renderer.prepare(technique, width_px, height_px, {sun(130, 80)});
    const Frame frame = render_frame(renderer, technique, camera, sun(130, 80));
    EXPECT_EQ(frame.count("triangles_drawn") > 0, pyramid == std::string("off")) << pyramid;
    EXPECT_GT(shadowed(frame), 100u);
  }
}

TEST(Compute, AlphaMasksThatHaveNoRoomToBeAskedAreAskedInDouble) {
  const Scene scene = masked_tangle(216);
  const Frame whole = render_frame(scene, camera, sun(130, 35), width_px, height_px, with(exact, compute));
  for (const char* pairs : {"0", "50"}) {
    const Frame frame =
        render_frame(scene, camera, sun(130, 35), width_px, height_px, with(with(exact, compute), {{"pairs", pairs}}));
    EXPECT_EQ(different(frame.mask, whole.mask), 0u) << pairs;
  }
}

TEST(Compute, ItsWorkAddsUpAndItsTestsCanBeStored) {
  for (const Scene& scene : {tangle(209, 300), masked_tangle(210)}) {
    Izb technique;
    set_options(technique, {{"spp", "32"}, {"removal", "off"}, {"grid", "64"}, {"raster", "compute"}});
    Renderer renderer(scene, capabilities());
    const Light light = point_light({0.5, 2.5, 0.4});
    renderer.prepare(technique, width_px, height_px, {light});
    const Frame frame = render_frame(renderer, technique, camera, light);
    EXPECT_GT(frame.count("visibility_tests"), 3000u);
    EXPECT_EQ(sum_of(renderer.tests_a_pixel()), frame.count("visibility_tests"));
    EXPECT_EQ(sum_of(renderer.fragments_a_texel()), frame.count("fragments_after_zcull"));
    const SpeedOfLight alone = renderer.speed_of_light(0, 1).value();
    EXPECT_EQ(alone.tests, frame.count("visibility_tests"));
    EXPECT_TRUE(alone.same_mask);
    EXPECT_EQ(renderer.read_mask(), frame.mask);
  }
}

TEST(Compute, TakesTheTrianglesPartByPart) {
  const Scene scene = masked_tangle(211);
  const DrawList list = make_draw_list(scene, 64);
  const auto buffers = std::make_shared<SceneBuffers>(scene, list, capabilities());
  using Parts = std::vector<std::pair<uint32_t, uint32_t>>;
  const auto parts = [&](Drawn drawn, uint32_t most) {
    Parts all;
    buffers->for_casters(drawn, most, [&](uint32_t first, uint32_t end) { all.emplace_back(first, end); });
    return all;
  };
  const uint32_t opaque = opaque_triangles(list), all = list.triangle_count;
  EXPECT_GT(opaque, 100u);
  EXPECT_LT(opaque, all);
  EXPECT_EQ(parts(Drawn::all, 100000), (Parts{{0, all}}));
  EXPECT_EQ(parts(Drawn::opaque, 100000), (Parts{{0, opaque}}));
  EXPECT_EQ(parts(Drawn::masked, 100000), (Parts{{opaque, all}}));
  EXPECT_EQ(parts(Drawn::masked, all - opaque - 1), (Parts{{opaque, all - 1}, {all - 1, all}}));

  // Frames by many parts, and one that is given up between them.
  Izb technique;
  set_options(technique, with(exact, compute));
  Renderer renderer(scene, capabilities(), buffers);
  renderer.prepare(technique, width_px, height_px, {sun(130, 35)});
  const Frame whole = render_frame(renderer, technique, camera, sun(130, 35));
  int calls = 0, most = 1000;
  buffers->between_draws = [&] {
    if (++calls > most) fail("given up");
  };
  EXPECT_EQ(render_frame(renderer, technique, camera, sun(130, 35)).mask, whole.mask);
  EXPECT_GT(calls, 8);
  gpu::StageTimers timers(true);
  for (most = 1; most < 12; most += 3) {
    calls = 0;
    EXPECT_THROW(renderer.render(camera, {sun(130, 35)}, timers), Error) << most;
  }
  buffers->between_draws = nullptr;
  EXPECT_EQ(render_frame(renderer, technique, camera, sun(130, 35)).mask, whole.mask);
}

TEST(Compute, WithoutStorageBlocksInTheVertexShaderIsANamedRefusal) {
  Izb technique;
  set_options(technique, compute);
  EXPECT_EQ(technique.missing(capabilities()), "");
  gpu::Capabilities less = capabilities();
  less.max_vertex_storage_blocks = 2;
  EXPECT_NE(technique.missing(less).find("--raster compute reads 4 storage blocks in the vertex shader"),
            std::string::npos)
      << technique.missing(less);
}

}  // namespace
}  // namespace izb::test

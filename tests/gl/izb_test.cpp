// SPDX-License-Identifier: MIT
// The room `izb` on small scenes: lists, the brute-force mask, what must not change the mask, and what z-cull saves.
#include <algorithm>
#include <numeric>

#include "gl/frame_fixture.h"
#include "shadow/izb/hardware_raster.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;

/// Triangles of all sizes over a floor: from specks to ones 10^4 times the window, some with needles and duplicates.
Scene tangled_scene(uint32_t seed, int triangles, double largest = 1.0) {
  Random random(seed);
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f, 3));
  std::vector<glm::vec3> soup;
  for (int i = 0; i < triangles; ++i) {
    const double size = std::pow(10.0, random.uniform(-2.0, 0.3)) * (i % 16 == 0 ? largest : 1.0);
    const glm::dvec3 center = glm::dvec3(0, 2.0, 0) + random.point(1.0) * glm::dvec3(4.0, 1.9, 4.0);
    glm::dvec3 a = center + random.point(size), b = center + random.point(size), c = center + random.point(size);
    if (i % 5 == 0) c = glm::mix(a, b, 0.3) + random.point(1e-5);
    for (const glm::dvec3& v : {a, b, c}) soup.push_back(glm::vec3(v));
    if (i % 11 == 0) soup.insert(soup.end(), soup.end() - 3, soup.end());
  }
  add_soup(scene, soup,
           glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 3, 2))) *
               glm::translate(glm::dmat4(1.0), {0.1, 0.2, 0.3}));
  return scene;
}

const Camera camera = look_at({5, 6, 7}, {0, 0.5, 0}, glm::radians(50.0));

std::vector<Light> lights() {
  return {sun(130, 35), sun(20, 3), spot({1, 5, 2}, {0, 0, 0}, 55), point_light({0.6, 1.9, 0.7})};
}

TEST(Izb, EveryReceiverStandsInExactlyOneListAndNothingElseInAny) {
  const Scene scene = tangled_scene(31, 200);
  for (const Light& light : lights())
    for (const char* grid : {"16", "257", "1024"}) {
      const Frame frame =
          render_frame(scene, camera, light, width_px, height_px, {{"grid", grid}, {"occluders", "off"}});
      // A pixel has one next pointer; list_lengths throws if two lists share it.
      for (size_t i = 0; i < frame.mask.size(); ++i)
        EXPECT_EQ(frame.list_lengths[i] > 0.0f, frame.receivers.classes[i] == reference::PixelClass::receiver) << i;
      EXPECT_EQ(frame.count("nodes"), receivers(frame));
      EXPECT_GT(frame.count("nodes"), 1000u);
    }
}

TEST(Izb, TheMaskIsTheBruteForceMask) {
  for (uint32_t seed = 0; seed < 6; ++seed) {
    const Scene scene = tangled_scene(40 + seed, 150, seed % 2 ? 1e4 : 1.0);
    for (const Light& light : lights()) {
      const Frame frame = render_frame(scene, camera, light, width_px, height_px, {{"grid", "512"}});
      EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u) << "seed " << seed << " light " << int(light.type);
      EXPECT_GT(shadowed(frame), 20u);
      expect_explained(frame);
    }
  }
}

TEST(Izb, VerticesOnTexelBordersAndCornersLoseNoTexel) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f, 3));
  const Camera low = look_at({1.0, 2.0, 1.5}, {0, 0, 0}, glm::radians(60.0));
  const Light light = sun(70, 60);
  const Settings settings{{"grid", "64"}};
  const Frame bare = render_frame(scene, low, light, width_px, height_px, settings);
  // Triangles above the camera, out of the picture, so that the window stays; their vertices lie on whole texels of it.
  Random random(60);
  const shared::LightFrame& frame = bare.inputs.light;
  const auto on_border = [&](int x, int y) {
    const double u = bare.window.window.x + x / double(bare.window.window.z);
    const double v = bare.window.window.y + y / double(bare.window.window.w);
    const double depth = random.uniform(-9.0, -7.0);
    const glm::dvec3 p = glm::dvec3(glm::vec3(frame.axis_x)) * u + glm::dvec3(glm::vec3(frame.axis_y)) * v +
                         glm::dvec3(glm::vec3(frame.axis_z)) * depth;
    return glm::vec3(glm::dvec3(low.world_from_view * glm::dvec4(p, 1.0)));
  };
  std::vector<glm::vec3> soup;
  for (int i = 0; i < 120; ++i) {
    const int x = int(random.below(60)), y = int(random.below(60));
    soup.push_back(on_border(x, y));
    soup.push_back(on_border(x + int(random.below(5)), y + int(random.below(3))));
    soup.push_back(on_border(x + int(random.below(3)), y + int(random.below(5))));
  }
  add_soup(scene, soup);
  const Frame with = render_frame(scene, low, light, width_px, height_px, settings);
  ASSERT_EQ(with.window.window, bare.window.window);
  EXPECT_EQ(different(with.mask, brute_force_mask(with)), 0u);
  EXPECT_GT(shadowed(with), 50u);
}

TEST(Izb, TheMaskDoesNotDependOnGridZCullOrTheRoomForUnsurePairs) {
  const Scene scene = tangled_scene(50, 300);
  for (const Light& light : lights()) {
    const Frame base = render_frame(scene, camera, light, width_px, height_px);
    for (const Settings& settings :
         {Settings{{"grid", "256"}}, Settings{{"grid", "1000"}}, Settings{{"grid", "4096"}}, Settings{{"zcull", "off"}},
          Settings{{"zcull-pyramid", "off"}}, Settings{{"pairs", "0"}}, Settings{{"pairs", "3"}, {"zcull", "off"}}}) {
      const Frame other = render_frame(scene, camera, light, width_px, height_px, settings);
      EXPECT_EQ(different(base.mask, other.mask), 0u) << settings[0].first << " " << settings[0].second;
    }
  }
}

TEST(Izb, PairsInDoubleAreFewAndWithoutRoomForThemAllIsDoneInDouble) {
  const Scene scene = tangled_scene(51, 300);
  const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  EXPECT_GT(frame.count("pairs_in_double"), 3u);  // the settings above do overflow
  EXPECT_LT(frame.count("pairs_in_double"), frame.count("visibility_tests") / 20);
}

// A walk puts a few unsure pairs off and stops where it has no room for more: lists that hold far more of them.
TEST(Izb, NoUnsurePairOfALongListIsLost) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(16.0f));
  // A row of pixel centres lies on the border of the shadow, to the last bit: pixels are 1/8 wide.
  add_soup(scene, rectangle({6.5f, 6.0f, -0.0625f}, {6.0f, 0, 0}, {0, 0, 3.0f}));
  Camera above = look_at({0, 10, 0}, {0, 0, 0}, 1.0);
  above.orthographic = true;
  above.ymag = 4.0;
  above.near_plane = 0.1;
  above.far_plane = 40.0;
  for (const char* raster : {"gs", "compute"})
    for (const char* removal : {"on", "off"}) {
      const Frame frame = render_frame(scene, above, sun(90, 45), width_px, height_px,
                                       {{"grid", "16"}, {"raster", raster}, {"removal", removal}});
      EXPECT_GT(frame.count("pairs_in_double"), 40u);
      EXPECT_GT(shadowed(frame), 1000u);
      EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u) << raster << ", removal " << removal;
    }
}

TEST(Izb, TheMaskDoesNotDependOnTheOrderOfTrianglesOrInstances) {
  Scene scene = tangled_scene(52, 200);
  const Frame base = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  std::vector<uint32_t> order(scene.meshes[1].indices.size() / 3);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<uint32_t> indices;
  for (const uint32_t k : order)
    for (const uint32_t corner : {1u, 2u, 0u}) indices.push_back(scene.meshes[1].indices[3 * k + corner]);
  scene.meshes[1].indices = indices;
  std::swap(scene.meshes[0], scene.meshes[1]);
  std::swap(scene.instances[0].world_from_object, scene.instances[1].world_from_object);
  const Frame other = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  // Duplicates tie in depth, so a pixel's own triangle, and with it its rounding, may be another: compare where it is
  // not.
  size_t compared = 0, differing = 0;
  for (size_t i = 0; i < base.mask.size(); ++i) {
    if (base.gbuffer.eye_distance[i] != other.gbuffer.eye_distance[i]) continue;
    ++compared;
    differing += base.mask[i] != other.mask[i];
  }
  EXPECT_EQ(differing, 0u);
  EXPECT_GT(compared, base.mask.size() * 99 / 100);
}

TEST(Izb, ZCullSavesFragmentsAndACasterBehindAllReceiversCostsNone) {
  const Scene scene = tangled_scene(53, 300);
  const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"grid", "256"}});
  EXPECT_LT(frame.count("fragments_after_zcull"), frame.count("fragments") * 3 / 4);

  // A floor that fills the picture, with and without a larger one below it that no receiver lies behind.
  Scene bare = empty_scene();
  add_soup(bare, floor_of(4.0f));
  Scene buried = bare;
  add_soup(buried, rectangle({-6, -0.5, -6}, {0, 0, 12}, {12, 0, 0}));
  const Camera close = look_at({0.3, 1.5, 0.3}, {0, 0, 0}, glm::radians(40.0));
  const Frame with = render_frame(buried, close, sun(130, 60), width_px, height_px, {{"grid", "256"}});
  const Frame without = render_frame(bare, close, sun(130, 60), width_px, height_px, {{"grid", "256"}});
  EXPECT_GT(with.count("fragments"), without.count("fragments"));
  EXPECT_EQ(with.count("fragments_after_zcull"), without.count("fragments_after_zcull"));
  EXPECT_EQ(shadowed(with), 0u);
}

TEST(Izb, ThePyramidEndsTrianglesThatNoReceiverLiesBehindAndCostsNoOccluder) {
  const Scene scene = tangled_scene(59, 600);
  for (const char* grid : {"64", "250", "1024"}) {
    const Frame with = render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"grid", grid}});
    const Frame without =
        render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"grid", grid}, {"zcull-pyramid", "off"}});
    EXPECT_EQ(different(with.mask, without.mask), 0u);
    EXPECT_LT(with.count("triangles_after_zcull"), without.count("triangles_after_zcull") * 95 / 100) << grid;
    // It knows depths to 32 bits, early z to 16 rounded up: it may end a triangle of which that lets a fragment
    // through.
    EXPECT_LE(with.count("fragments_after_zcull"), without.count("fragments_after_zcull")) << grid;
    EXPECT_GT(with.count("fragments_after_zcull"), without.count("fragments_after_zcull") * 98 / 100) << grid;
  }
}

TEST(Izb, HardwareRasterWritesTheMaskOfTheGeometryShader) {
  if (const std::string lack = HardwareRaster::missing(capabilities(), 0.5); !lack.empty()) GTEST_SKIP() << lack;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    const Scene scene = tangled_scene(70 + seed, 300, seed % 2 ? 1e4 : 1.0);
    for (const Light& light : lights())
      for (const Settings& settings :
           {Settings{{"grid", "512"}},
            {{"grid", "512"}, {"zcull", "off"}},
            {{"grid", "512"}, {"pairs", "0"}},
            {{"grid", "256"}, {"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"cascades", "4"}}}) {
        const Frame ours = render_frame(scene, camera, light, width_px, height_px, with(settings, {{"raster", "hw"}}));
        const Frame theirs = render_frame(scene, camera, light, width_px, height_px, settings);
        EXPECT_EQ(different(ours.mask, theirs.mask), 0u) << "seed " << seed << " light " << int(light.type);
      }
  }
}

TEST(HardwareRaster, DilatesByWhatTheDriverHas) {
  gpu::Capabilities driver;
  EXPECT_EQ(
      HardwareRaster::missing(driver, 0.5),
      "--raster hw needs GL_NV_conservative_raster and GL_NV_geometry_shader_passthrough, which this driver lacks");
  driver.extensions = {"GL_NV_conservative_raster", "GL_NV_geometry_shader_passthrough"};
  EXPECT_EQ(HardwareRaster::missing(driver, 0.5), "");
  EXPECT_EQ(HardwareRaster(driver, 0.5).shifts().size(), 4u);
  EXPECT_EQ(HardwareRaster(driver, 0.5).square(), 0.75f);
  EXPECT_NE(HardwareRaster::missing(driver, 1.0).find("0.6875 texels without GL_NV_conservative_raster_dilate"),
            std::string::npos);
  driver.raster_dilation_px = 0.75f;
  driver.raster_dilation_step_px = 0.25f;
  EXPECT_EQ(HardwareRaster(driver, 0.5).shifts().size(), 1u);
  EXPECT_EQ(HardwareRaster(driver, 0.5).square(), 0.75f);
  EXPECT_EQ(HardwareRaster::missing(driver, 1.0), "");
  EXPECT_EQ(HardwareRaster(driver, 1.0).square(), 1.25f);
  EXPECT_NE(HardwareRaster::missing(driver, 1.5).find("1.1875 texels with GL_NV_conservative_raster_dilate"),
            std::string::npos);
}

TEST(Izb, NlCullLeavesOutOnlyPixelsWhoseLightTermIsZero) {
  const Scene scene = tangled_scene(54, 300);
  const Frame culled = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  const Frame all = render_frame(scene, camera, sun(130, 35), width_px, height_px, {{"nl-cull", "off"}});
  EXPECT_LT(culled.count("nodes"), all.count("nodes"));
  for (size_t i = 0; i < culled.mask.size(); ++i) {
    EXPECT_EQ(culled.mask[i], culled.receivers.classes[i] == reference::PixelClass::culled ? 0u : all.mask[i]);
  }
}

TEST(Izb, NothingInViewIsASkyWithoutShadow) {
  const Scene scene = tangled_scene(55, 10);
  const Camera away = look_at({0, 50, 0}, {0, 100, 1}, 0.7);
  const Frame frame = render_frame(scene, away, sun(130, 35), width_px, height_px);
  EXPECT_EQ(receivers(frame), 0u);
  EXPECT_EQ(shadowed(frame), 0u);
  EXPECT_EQ(frame.count("fragments"), 0u);
}

TEST(Izb, AnOrthographicCameraAndAFiniteFarPlaneWork) {
  const Scene scene = tangled_scene(56, 150);
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 4.0;
  flat.near_plane = 0.1;
  flat.far_plane = 40.0;
  Camera finite = camera;
  finite.near_plane = 0.1;
  finite.far_plane = 40.0;
  for (const Camera& c : {flat, finite}) {
    const Frame frame = render_frame(scene, c, sun(130, 35), width_px, height_px);
    EXPECT_EQ(different(frame.mask, brute_force_mask(frame)), 0u);
    EXPECT_GT(shadowed(frame), 50u);
    expect_explained(frame);
  }
}

TEST(Izb, FlattenOnTheCpuIsWhatTheGpuTransforms) {
  // The receiver points come from the GPU's transform; if C++ rounded differently they would leave their planes.
  const Scene scene = tangled_scene(57, 200);
  const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  for (size_t i = 0; i < frame.mask.size(); ++i) {
    if (frame.gbuffer.id[i].x == 0u) continue;
    const glm::vec3* v = &frame.triangles_vs[3 * frame.receivers.own_triangle[i]];
    const glm::vec2 px = frame.gbuffer.center_px(i);
    EXPECT_EQ(shared::intersect_plane(frame.inputs.camera, px, v[0], v[1], v[2]).eye_distance,
              frame.gbuffer.eye_distance[i])
        << i;
  }
}

TEST(RayTraced, WritesTheSameMaskButForDisputedBits) {
  const Scene scene = tangled_scene(58, 200);
  const Frame ours = render_frame(scene, camera, sun(130, 35), width_px, height_px);
  const Frame rays = render_frame(scene, camera, sun(130, 35), width_px, height_px, {}, "ray_traced");
  EXPECT_LE(different(ours.mask, rays.mask), 3u);
  EXPECT_GT(shadowed(rays), 50u);
}

}  // namespace
}  // namespace izb::test

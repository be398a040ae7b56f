// SPDX-License-Identifier: MIT
// Frames whose rays pass beside the pixel centres: as true as others; the points of the sequence; and triangles that
// stay the same meanwhile.
#include <cmath>
#include <set>

#include "gl/frame_fixture.h"
#include "reference/points.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 72;

Camera perspective() {
  return look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
}

Camera orthographic() {
  Camera camera = perspective();
  camera.orthographic = true;
  camera.ymag = 4.0;
  camera.near_plane = 0.1, camera.far_plane = 30.0;
  return camera;
}

TEST(PixelShift, EveryRunOf2ToTheKHasOnePointInEachBoxOfThatArea) {
  EXPECT_EQ(pixel_shift(0), glm::dvec2(0.0));
  for (const uint32_t first : {0u, 64u, 448u, 4096u})
    for (int k = 0; k <= 6; ++k)
      for (int columns = 0; columns <= k; ++columns) {
        std::set<std::pair<int, int>> boxes;
        for (uint32_t n = first; n < first + (1u << k); ++n) {
          const glm::dvec2 p = pixel_shift(n) + 0.5;
          EXPECT_TRUE(p.x >= 0.0 && p.y >= 0.0 && p.x < 1.0 && p.y < 1.0) << n;
          boxes.emplace(int(p.x * (1 << columns)), int(p.y * (1 << (k - columns))));
        }
        EXPECT_EQ(boxes.size(), size_t(1) << k) << first << ", " << k << ", " << columns;
      }
}

TEST(PixelShift, MatricesAndRaysOfBothSidesMeetInTheShiftedPixel) {
  for (Camera camera : {perspective(), orthographic()}) {
    camera.pixel_shift = {0.375, -0.28125};
    const shared::CameraFrame frame = make_camera_frame(camera, width_px, height_px);
    const reference::PixelRays rays = reference::pixel_rays(camera, width_px, height_px);
    for (const glm::ivec2 px : {glm::ivec2(0, 0), {95, 0}, {40, 71}, {17, 30}}) {
      const double t = 3.25;
      const glm::dvec3 truth = rays.origin_at(px.x, px.y) + t * rays.direction_at(px.x, px.y);
      const glm::vec2 center(float(px.x) + 0.5f, float(height_px - 1 - px.y) + 0.5f);
      const glm::dvec3 point(shared::receiver_point(frame, center, float(t)));
      const glm::dvec4 clip = glm::dmat4(frame.clip_from_view) * glm::dvec4(truth, 1.0);
      const glm::dvec2 there_px = (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * glm::dvec2(width_px, height_px);
      // Roundings of floats as large as half the picture: 2^-23 of 48 pixels, some of them added up.
      EXPECT_LT(glm::length(there_px - glm::dvec2(center)), 4e-5);
      EXPECT_LT(glm::length(point - truth), 4e-5 * shared::pixel_width(frame, float(t)));
    }
  }
}

TEST(PixelShift, FramesAreAsTrueAsThoseThroughTheCentres) {
  const Scene scene = tangle(3, 200);
  const Settings exact{{"coverage", "exact"}, {"insertion", "exact"}};
  const std::pair<Camera, Light> views[] = {{perspective(), spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40)},
                                            {orthographic(), sun(130, 35)}};
  for (const auto& [camera, light] : views)
    for (const auto& [technique, settings] : {std::pair<const char*, Settings>{"izb", {}},
                                              {"izb", with(exact, {{"spp", "32"}})},
                                              {"ray_traced", {{"spp", "32"}}}}) {
      const Frame centred = render_frame(scene, camera, light, width_px, height_px, settings, technique);
      Camera shifted = camera;
      shifted.pixel_shift = {0.4375, -0.3125};
      const Frame frame = render_frame(scene, shifted, light, width_px, height_px, settings, technique);
      EXPECT_NE(frame.mask, centred.mask);
      EXPECT_GT(receivers(frame), 1000u);
      expect_explained(frame);
      const auto rays = [&](const Camera& its) { return reference::pixel_rays(its, width_px, height_px); };
      const reference::RayTracer tracer(frame.triangles);
      EXPECT_EQ(check_points(tracer, frame.triangles, rays(shifted), frame.receivers).wrong, 0u);
      // Points that are not where the camera says are found.
      EXPECT_GT(check_points(tracer, frame.triangles, rays(camera), frame.receivers).wrong, 10u);
    }
}

TEST(PixelShift, AWholePixelIsTheNeighboursFrame) {
  const Scene scene = tangle(3, 200);
  Camera camera = perspective();
  const Light light = sun(130, 35);
  for (const char* technique : {"izb", "ray_traced", "shadow_map"}) {
    const Frame here = render_frame(scene, camera, light, width_px, height_px, {}, technique);
    Camera shifted = camera;
    shifted.pixel_shift = {1.0, 0.0};
    const Frame there = render_frame(scene, shifted, light, width_px, height_px, {}, technique);
    size_t other = 0;
    for (size_t i = 0; i < here.mask.size(); ++i)
      if (i % width_px != 0) other += here.mask[i] != there.mask[i - 1];
    // Rounding moves rays by some 1e-5 pixel; a depth map's window follows the receivers, and its texels with it.
    EXPECT_LT(other, technique == std::string("shadow_map") ? here.mask.size() / 20 : 3u) << technique;
  }
}

/// What a technique is told, and a mask that it makes of that.
struct Kept {
  std::unique_ptr<Technique> technique = make_technique("ray_traced");
  Renderer renderer;

  explicit Kept(const Scene& scene, bool keep) : renderer(scene, capabilities()) {
    set_options(*technique, {});
    renderer.prepare(*technique, width_px, height_px, {sun(130, 35)});
    renderer.keep_geometry(keep);
  }
  std::vector<uint32_t> mask(const Camera& camera) {
    gpu::StageTimers timers(true);
    renderer.render(camera, {sun(130, 35)}, timers);
    return renderer.read_mask();
  }
  uint64_t geometry() const { return renderer.inputs().geometry; }
};

TEST(PixelShift, TrianglesKeepTheirNumberUntilTheyMove) {
  Scene scene = tangle(3, 200);
  MorphTarget target;
  target.positions.assign(scene.meshes[1].positions.size(), glm::vec3(0.3f, 0.5f, -0.2f));
  scene.meshes[1].targets.push_back(target);
  scene.instances[1].morph_weights = {0.0f};
  Kept kept(scene, true);
  Camera camera = perspective();
  const auto expect_as_fresh = [&](const char* what) {
    EXPECT_EQ(kept.mask(camera), Kept(scene, false).mask(camera)) << what;
    return kept.geometry();
  };
  const uint64_t first = expect_as_fresh("first");
  EXPECT_NE(first, 0u);
  camera.pixel_shift = {0.25, -0.125};
  EXPECT_EQ(expect_as_fresh("shifted"), first);
  scene.instances[1].morph_weights = {1.0f};
  const uint64_t morphed = expect_as_fresh("morphed");
  EXPECT_NE(morphed, first);
  scene.instances[1].world_from_object = glm::translate(glm::dmat4(1.0), {0.5, 0.0, 0.25});
  const uint64_t moved = expect_as_fresh("moved");
  EXPECT_NE(moved, morphed);
  camera = look_at({4.0, 5.0, 7.0}, {0, 0.8, 0}, glm::radians(50.0));
  EXPECT_NE(expect_as_fresh("another view"), moved);
  // Nothing is kept unless it is asked for.
  kept.renderer.keep_geometry(false);
  kept.mask(camera);
  EXPECT_EQ(kept.geometry(), 0u);
}

}  // namespace
}  // namespace izb::test

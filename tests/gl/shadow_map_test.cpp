// SPDX-License-Identifier: MIT
// The parts of the technique shadow_map: windows, the comparison's arithmetic, the map itself, memory and counts.
#include "shadow/shadow_map/shadow_map.h"

#include <numeric>

#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const Camera camera = look_at({4.0, 3.0, 6.0}, {0.0, 0.8, 0.0}, glm::radians(50.0));

shared::LightFrame light_frame(const Camera& eye, const Light& light, int cascades, int side = 512) {
  GridRequest grid;
  grid.texels = side;
  grid.cascades = cascades;
  grid.world_axes = true;
  return make_light_frame(eye, make_camera_frame(eye, width_px, height_px), light, grid);
}

FixedWindows fixed_windows(const Camera& eye, const shared::LightFrame& light, bool stable, int margin = 0) {
  return make_fixed_windows(eye, make_camera_frame(eye, width_px, height_px), light, {20.0, 0.5, stable, margin});
}

TEST(ShadowMapSplits, AreUniformOrLogarithmicAndEndAtTheDistance) {
  const std::vector<double> uniform = split_frustum(1.0, 81.0, 0.0, 4), ratios = split_frustum(1.0, 81.0, 1.0, 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(uniform[size_t(i)], 1.0 + 20.0 * (i + 1), 1e-12);
    EXPECT_NEAR(ratios[size_t(i)], std::pow(3.0, i + 1), 1e-12);
  }
  EXPECT_NEAR(split_frustum(1.0, 81.0, 0.25, 2)[0], 0.25 * 9.0 + 0.75 * 41.0, 1e-12);
}

TEST(ShadowMapWindows, OfTheCameraHoldWhatItSees) {
  Random random(4);
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 3.0;
  for (const Camera& eye : {camera, flat})
    for (const bool stable : {false, true})
      for (const int margin : {0, 5}) {
        const shared::LightFrame light = light_frame(eye, sun(130, 35), 4);
        const shared::CameraFrame frame = make_camera_frame(eye, width_px, height_px);
        const FixedWindows fixed = fixed_windows(eye, light, stable, margin);
        for (int i = 0; i < 2000; ++i) {
          const float t = float(random.uniform(eye.near_plane * 1.001, 19.999));
          const glm::vec2 px(random.uniform(0, width_px), random.uniform(0, height_px));
          const glm::vec3 p = shared::receiver_point(frame, px, t);
          const shared::LightWindow& w = fixed.windows[size_t(shared::cascade_of(fixed.range, 4, t))];
          const glm::vec3 at = shared::grid_position(w, shared::light_uvd(light, shared::light_position(light, p)));
          // A border of one texel and the margin, less what floats round 20 units to in texels of 1/10 unit or more.
          EXPECT_GT(std::min(at.x, at.y), float(margin) + 0.99f);
          EXPECT_LT(std::max(at.x, at.y), 512.0f - float(margin) - 0.99f);
          EXPECT_GT(at.z, 0.2499f);
          EXPECT_LT(at.z, 0.7501f);
        }
      }
}

TEST(ShadowMapWindows, ThatAreStableMoveByWholeTexelsOfTheWorld) {
  Random random(5);
  const Light light = sun(130, 35);
  const FixedWindows first = fixed_windows(camera, light_frame(camera, light, 3), true, 2);
  for (int i = 0; i < 50; ++i) {
    Camera moved = look_at(glm::dvec3(4, 3, 6) + random.point(2.0), random.point(1.0), camera.yfov_rad);
    moved.near_plane = camera.near_plane;
    const shared::LightFrame frame = light_frame(moved, light, 3);
    const FixedWindows fixed = fixed_windows(moved, frame, true, 2);
    const glm::dvec3 eye_vs = glm::transpose(glm::dmat3(moved.world_from_view)) * glm::dvec3(moved.world_from_view[3]);
    for (size_t c = 0; c < 3; ++c) {
      const glm::vec4 &w = fixed.windows[c].window, &w0 = first.windows[c].window;
      EXPECT_NEAR(w.z / w0.z, 1.0f, 1e-6f);
      EXPECT_EQ(w.z, w.w);
      const double x = (double(w.x) + glm::dot(glm::dvec3(frame.axis_x), eye_vs)) * double(w.z);
      const double y = (double(w.y) + glm::dot(glm::dvec3(frame.axis_y), eye_vs)) * double(w.w);
      // Floats of axes and windows: 20 units of 2^-24 in texels of 1/250 unit.
      EXPECT_NEAR(x, std::round(x), 2e-3);
      EXPECT_NEAR(y, std::round(y), 2e-3);
    }
  }
}

TEST(ShadowMapWindows, OfALampAreAllThatItLights) {
  for (const double angle : {20.0, 50.0}) {
    const shared::LightFrame light = light_frame(camera, spot({1, 4, 1}, {0, 0, 0}, angle), 2);
    const FixedWindows fixed = fixed_windows(camera, light, false);
    const float border = shared::grid_position(fixed.windows[0], glm::vec3(std::tan(glm::radians(angle)), 0, -1)).x;
    EXPECT_NEAR(border, 511.0f, 0.01f);
    EXPECT_EQ(fixed.windows[1].guard.y, 0.0f) << "one map is enough";
  }
  const FixedWindows cube = fixed_windows(camera, light_frame(camera, point_light({1, 4, 1}), 1), true);
  for (int face = 0; face < 6; ++face) EXPECT_EQ(cube.windows[size_t(face)].guard.y, 512.0f);
}

struct Kind {
  const char* name;
  Light light;
};
const Kind kinds[] = {
    {"sun", sun(130, 35)}, {"spot", spot({1.5, 6.0, -0.5}, {0, 0, 0}, 50)}, {"point", point_light({1.5, 6.0, -0.5})}};

/// What hardware makes of clip space is the grid position; and the receiver's plane is where its points are.
TEST(ShadowMapArithmetic, OfClipSpaceAndPlanesIsThatOfPoints) {
  Random random(6);
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    const shared::LightFrame light = light_frame(camera, kind.light, 1);
    const FixedWindows fixed = fixed_windows(camera, light, false);
    for (int i = 0; i < 500; ++i) {
      const glm::vec3 p = shared::receiver_point(make_camera_frame(camera, width_px, height_px),
                                                 glm::vec2(random.uniform(0, width_px), random.uniform(0, height_px)),
                                                 float(random.uniform(2.0, 12.0)));
      const int face = light.grid.z > 1 ? shared::face_of(shared::light_position(light, p)) : 0;
      const shared::LightFrame its = shared::light_face(light, face);
      const glm::vec3 p_ls = shared::light_position(its, p);
      if (!(p_ls.z > 0.5f) && shared::is_positional(light)) continue;  // beside the cone
      const shared::LightWindow w = shared::with_margin(fixed.windows[size_t(face)], 3.0f);
      const glm::vec3 grid = shared::grid_position(w, shared::light_uvd(its, p_ls));
      const glm::vec4 clip = shared::map_clip(its, w, 512.0f, p);
      const glm::vec3 ndc = glm::vec3(clip) / clip.w;
      // Single precision: 8 roundings of coordinates up to 10 against texels of 1/50.
      EXPECT_NEAR(256.0f + 256.0f * ndc.x, grid.x, 0.01f);
      EXPECT_NEAR(256.0f + 256.0f * ndc.y, grid.y, 0.01f);
      EXPECT_NEAR(ndc.z, grid.z, 1e-5f);

      glm::dvec3 normal = random.direction();
      const glm::dvec3 to_light = shared::is_positional(light) ? glm::dvec3(light.origin) - glm::dvec3(p)
                                                               : glm::dvec3(glm::vec3(light.to_light));
      if (glm::dot(normal, glm::normalize(to_light)) < 0.0) normal = -normal;
      if (glm::dot(normal, glm::normalize(to_light)) < 0.15) continue;  // steeper than the limit
      const shared::MapBias none{0.0f, 0.0f, 0.0f, 1.0f};
      const shared::MapReceiver r = shared::make_map_receiver(its, w, none, p, glm::vec3(normal));
      glm::dvec3 along = random.direction();
      along -= normal * glm::dot(normal, along);
      const glm::vec3 q = glm::vec3(glm::dvec3(p) + 0.02 * along);
      const glm::vec3 there = shared::grid_position(w, shared::light_uvd(its, shared::light_position(its, q)));
      // The rounding that bias covers, and that of the reference's own sum.
      EXPECT_NEAR(shared::map_reference(r, none, glm::vec2(there)), there.z, 4.0f * r.bias + 1e-6f);
    }
  }
}

TEST(ShadowMapArithmetic, MarginsKeepTheMiddleAndLeaveRoom) {
  shared::LightWindow w{};
  w.window = glm::vec4(-3.0f, 2.0f, 10.0f, 20.0f);
  w.guard.y = 128.0f;
  const shared::LightWindow wide = shared::with_margin(w, 7.0f);
  const auto at = [](const shared::LightWindow& of, float x) { return (x - of.window.x) * of.window.z; };
  const float low = -3.0f + 1.0f / 10.0f, high = -3.0f + 127.0f / 10.0f;
  EXPECT_NEAR(at(wide, low), 8.0f, 1e-3f);
  EXPECT_NEAR(at(wide, high), 120.0f, 1e-3f);
  EXPECT_NEAR(at(wide, 0.5f * (low + high)), at(w, 0.5f * (low + high)), 1e-3f);
}

TEST(ShadowMapFilter, PointsFillTheDisc) {
  for (const char* filter : {"disc8", "disc16", "disc32"}) {
    ShadowMapSettings settings;
    settings.filter = filter;
    settings.radius_texels = 3.0;
    const std::vector<glm::vec2> taps = settings.tap_offsets();
    EXPECT_EQ(int(taps.size()), settings.taps());
    double square = 0.0;
    glm::vec2 sum(0.0f);
    for (const glm::vec2& tap : taps) {
      EXPECT_LT(glm::length(tap), 3.0f);
      square += double(glm::dot(tap, tap));
      sum += tap;
    }
    // Of a disc: the mean square is r^2 / 2 for any number of such points; the mean point is the centre, within a tenth
    // of the radius.
    EXPECT_NEAR(square / double(taps.size()), 4.5, 1e-5);
    EXPECT_LT(glm::length(sum) / float(taps.size()), 0.3f) << filter;
    EXPECT_EQ(settings.margin_texels(), 3);
  }
}

TEST(ShadowMap, HoldsTheDepthOfWhatTheLightSees) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(40.0f));
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    ShadowMap technique;
    const Frame frame = render_frame(scene, camera, kind.light, width_px, height_px,
                                     {{"resolution", "128"}, {"filter", "none"}}, technique);
    const std::vector<float> map = technique.read_map();
    size_t compared = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i) {
      if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
      const shared::LightFrame& light = frame.inputs.light;
      const glm::vec3 p = frame.receivers.points_vs[i];
      const int face = light.grid.z > 1 ? shared::face_of(shared::light_position(light, p)) : 0;
      const glm::vec3 up = glm::normalize(shared::octahedral_direction(frame.gbuffer.normal[i]));
      const shared::MapBias none{0.0f, 0.0f, 0.0f, 1.0f};
      const shared::MapReceiver r =
          shared::make_map_receiver(shared::light_face(light, face), frame.windows[size_t(face)], none, p, up);
      const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(r.at)), 0, 127);
      const float reference = shared::map_reference(r, none, glm::vec2(texel) + 0.5f) + r.bias;
      // Where the ray through the texel's centre meets the plane: the floor may end before.
      const shared::LightWindow& w = frame.windows[size_t(face)];
      const glm::vec2 uv = glm::vec2(w.window) + (glm::vec2(texel) + 0.5f) / glm::vec2(w.window.z, w.window.w);
      const float d = (reference - w.depth.x) / w.depth.y;
      const glm::vec3 at_ls = shared::is_positional(light) ? glm::vec3(uv, 1.0f) / -d : glm::vec3(uv, d);
      const shared::LightFrame its = shared::light_face(light, face);
      const glm::vec3 at_vs = glm::vec3(light.origin) + at_ls.x * glm::vec3(its.axis_x) +
                              at_ls.y * glm::vec3(its.axis_y) + at_ls.z * glm::vec3(its.axis_z);
      const glm::dvec3 at_ws(camera.world_from_view * glm::dvec4(glm::dvec3(at_vs), 1.0));
      if (std::max(std::abs(at_ws.x), std::abs(at_ws.z)) > 20.0) continue;
      const float stored = map[(size_t(face) * 128 + size_t(texel.y)) * 128 + size_t(texel.x)];
      // Vertices snap to 1/256 texel, and the rasteriser's floats lose a little of a texel's slope.
      EXPECT_NEAR(stored, reference, r.bias + 0.02f * (std::abs(r.slope.x) + std::abs(r.slope.y))) << i;
      ++compared;
    }
    EXPECT_GT(compared, 2000u);
  }
}

TEST(ShadowMap, TakesTheMemoryThatItSays) {
  const Scene scene = tangle(1, 20);
  Renderer renderer(scene, capabilities());
  for (const std::vector<Light>& lights :
       {std::vector{sun(30.0, 50.0)}, {sun(30.0, 50.0), point_light({0.0, 2.0, 0.0})}})
    for (const Settings& settings : {Settings{{"resolution", "130"}}, Settings{{"cascades", "3"}},
                                     Settings{{"filter", "disc32"}, {"spp", "32"}, {"resolution", "64"}}}) {
      ShadowMap technique;
      set_options(technique, settings);
      const gpu::Plans plans = renderer.memory_needed(technique, width_px, height_px, lights);
      renderer.prepare(technique, width_px, height_px, lights);
      EXPECT_EQ(gpu::bytes_of(plans[0].second), renderer.memory()[0].second);
      const uint64_t side = uint64_t(technique.grid().texels), layers = lights.size() > 1 ? 6 : 1;
      EXPECT_EQ(technique.memory()[0].second, 4 * side * side * layers * uint64_t(technique.grid().cascades));
    }
}

TEST(ShadowMap, LargerThanTheDriverTakesIsRefusedInASentence) {
  ShadowMap technique;
  set_options(technique, {{"resolution", "8192"}});
  gpu::Capabilities little = capabilities();
  EXPECT_EQ(technique.missing(little), "");
  little.max_texture_size = 4096;
  EXPECT_EQ(technique.missing(little), "--resolution 8192 is beyond this driver's largest texture, 4096");
}

TEST(ShadowMap, CountsWhatItCompares) {
  const Scene scene = tangle(7, 100);
  for (const auto& [filter, comparisons] : {std::pair{"none", 1u}, {"pcf2x2", 4u}, {"disc8", 8u}, {"disc32", 32u}}) {
    const Frame frame = render_frame(scene, camera, sun(130, 35), width_px, height_px,
                                     {{"filter", filter}, {"resolution", "256"}}, "shadow_map");
    EXPECT_EQ(frame.count("lookups"), receivers(frame));
    EXPECT_EQ(frame.count("lookups_outside"), 0u);
    EXPECT_EQ(frame.count("comparisons"), comparisons * receivers(frame)) << filter;
    EXPECT_GT(frame.count("fragments_in_map"), 256u * 256u / 4);
  }
  const Frame many = render_frame(scene, camera, sun(130, 35), width_px, height_px,
                                  {{"filter", "disc8"}, {"spp", "32"}, {"resolution", "256"}}, "shadow_map");
  EXPECT_EQ(many.count("comparisons"), 32u * receivers(many)) << "each sample takes one point of the filter";
}

TEST(ShadowMap, ReachesAsFarAsItsDistance) {
  const Scene scene = tangle(7, 100);
  const auto outside = [&](const char* fit, const char* distance) {
    return render_frame(scene, camera, sun(130, 35), width_px, height_px,
                        {{"fit", fit}, {"distance", distance}, {"resolution", "256"}}, "shadow_map")
        .count("lookups_outside");
  };
  for (const char* fit : {"camera", "stable"}) {
    EXPECT_EQ(outside(fit, "0"), 0u) << fit;
    EXPECT_GT(outside(fit, "4"), 100u) << fit;
  }
  EXPECT_EQ(outside("receivers", "4"), 0u);
}

TEST(ShadowMap, IsTheSameAfterOtherOptionsAndSizes) {
  const Scene scene = tangle(7, 100);
  const std::vector<Light> suns{sun(130, 35)};
  ShadowMap technique;
  Renderer renderer(scene, capabilities());
  gpu::StageTimers timers(true);
  const auto mask = [&](const Settings& settings, int width, int height) {
    set_options(technique, settings);
    renderer.prepare(technique, width, height, suns);
    renderer.render(camera, suns, timers);
    return renderer.read_mask();
  };
  const Settings usual{{"filter", "disc16"}, {"resolution", "128"}, {"cascades", "2"}, {"fit", "receivers"}};
  const std::vector<uint32_t> first = mask(usual, 64, 48);
  mask({{"filter", "pcf2x2"}, {"resolution", "300"}, {"cascades", "1"}, {"fit", "stable"}}, 30, 20);
  EXPECT_EQ(mask(usual, 64, 48), first);
  const uint64_t programs = gpu::programs_made();
  mask(with(usual, {{"bias", "3"}, {"radius", "4"}, {"resolution", "200"}, {"fit", "camera"}}), 64, 48);
  EXPECT_EQ(gpu::programs_made(), programs) << "none of these is compiled in";
}

}  // namespace
}  // namespace izb::test

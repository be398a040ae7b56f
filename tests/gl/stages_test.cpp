// SPDX-License-Identifier: MIT
// Stages `bounds` and `shade` alone, against the same computed on the CPU.
#include <algorithm>
#include <bit>

#include "frame/frame_setup.h"
#include "gl/frame_fixture.h"
#include "shared/bounds.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const Camera camera = look_at({5, 6, 7}, {0, 0.5, 0}, glm::radians(50.0));

Scene box_on_a_floor() {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f, 3));
  std::vector<glm::vec3> roof = rectangle({-1.0f, 1.5f, -1.0f}, {0, 0, 2}, {2, 0, 0});
  add_soup(scene, roof);
  return scene;
}

std::vector<Light> lights() {
  return {sun(130, 35), sun(20, 60), spot({1, 5, 2}, {0, 0, 0}, 40)};
}

TEST(Stages, TheBoundsWindowIsThatOfTheReceiversOnTheCpu) {
  const Scene scene = box_on_a_floor();
  for (const Light& light : lights()) {
    const Frame frame = render_frame(scene, camera, light, width_px, height_px);
    glm::vec3 low(3.0e38f), high(-3.0e38f);
    float uv_slack = 0.0f, d_slack = 0.0f;
    shared::ReceiverBounds bounds{};
    for (size_t i = 0; i < frame.mask.size(); ++i) {
      if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
      const glm::vec3 p = frame.receivers.points_vs[i], p_ls = shared::light_position(frame.inputs.light, p);
      const glm::vec3 uvd = shared::light_uvd(frame.inputs.light, p_ls);
      low = glm::min(low, uvd), high = glm::max(high, uvd);
      uv_slack = std::max(uv_slack, shared::uv_error(frame.inputs.light, p, p_ls));
      d_slack = std::max(d_slack, shared::d_error(frame.inputs.light, p, p_ls));
      ++bounds.slack.z;
    }
    ASSERT_GT(bounds.slack.z, 500u);
    for (int k = 0; k < 3; ++k) {
      bounds.low[k] = shared::ordered_from_float(low[k]);
      bounds.high[k] = shared::ordered_from_float(high[k]);
    }
    bounds.slack.x = shared::ordered_from_float(uv_slack);
    bounds.slack.y = shared::ordered_from_float(d_slack);
    const shared::LightWindow expected = shared::make_window(frame.inputs.light, bounds), &got = frame.window;
    // The shader's sums and divisions may round in another way.
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(got.window[k], expected.window[k], 1e-5f * (1.0f + std::abs(expected.window[k]))) << k;
      EXPECT_NEAR(got.depth[k], expected.depth[k], 1e-4f * std::abs(expected.depth[k])) << k;
      EXPECT_NEAR(got.guard[k], expected.guard[k], 1e-4f * std::abs(expected.guard[k])) << k;
    }
    // It is tight: its border is one texel wide.
    const float side = float(shared::last_texel(got) + 1);
    EXPECT_NEAR((low.x - got.window.x) * got.window.z, 1.0f, 0.05f);
    EXPECT_NEAR((high.y - got.window.y) * got.window.w, side - 1.0f, 0.05f);
  }
}

/// The light's share in the final render of a receiver without a shading normal, white but for a missing green, in
/// double.
glm::dvec3 shaded(const Frame& frame, const Light& light, double strength, size_t i) {
  if (frame.receivers.classes[i] != reference::PixelClass::receiver) return glm::dvec3(0.0);
  const shared::LightFrame& its = frame.inputs.light;
  const glm::dvec3 p = frame.receivers.points_vs[i], albedo(1.0, 0.0, 1.0);
  const glm::dvec3 n = glm::normalize(glm::dvec3(shared::octahedral_direction(frame.gbuffer.normal[i])));
  glm::dvec3 to_light = glm::dvec3(glm::vec3(its.to_light));
  double arriving = strength;
  if (light.type != LightType::directional) {
    to_light = glm::dvec3(glm::vec3(its.origin)) - p;
    const double distance = glm::length(to_light);
    to_light /= distance;
    arriving /= distance * distance;
    if (light.range > 0.0) arriving *= std::max(1.0 - std::pow(distance / light.range, 4.0), 0.0);
    if (light.type == LightType::spot) {
      const double along = -glm::dot(glm::dvec3(glm::vec3(its.axis_z)), to_light);
      const double inner = std::cos(light.inner_cone_rad), outer = std::cos(light.outer_cone_rad);
      const double x = std::clamp((along - outer) / (inner - outer), 0.0, 1.0);
      arriving *= x * x * (3.0 - 2.0 * x);
    }
  }
  const double visibility = 1.0 - std::popcount(frame.mask[i]) / 32.0, diffuse = std::max(glm::dot(n, to_light), 0.0);
  const glm::dvec3 halfway = glm::normalize(to_light - glm::normalize(p));
  const double specular = diffuse > 0.0 ? 0.04 * std::pow(std::max(glm::dot(n, halfway), 0.0), 32.0) : 0.0;
  return glm::dvec3(light.color) * (arriving * visibility) * (albedo * diffuse + specular);
}

/// Sky and ambient light of a receiver.
glm::dvec3 unlit(const Frame& frame, const shared::ShadeFrame& shade, size_t i) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(shared::octahedral_direction(frame.gbuffer.normal[i])));
  const glm::dvec3 up = glm::vec3(shade.up_vs), ground = glm::vec3(shade.ground), zenith = glm::vec3(shade.sky_zenith);
  return glm::dvec3(1.0, 0.0, 1.0) * double(shade.up_vs.w) * glm::mix(ground, zenith, 0.5 + 0.5 * glm::dot(n, up));
}

TEST(Stages, ShadeIsPhongWithTheMaskSummedOverTheLights) {
  Scene scene = box_on_a_floor();
  scene.materials[0].base_color = {1.0f, 0.0f, 1.0f, 1.0f};  // exact in eight bits
  std::vector<std::vector<Light>> sets;
  for (const Light& light : lights()) sets.push_back({light});
  Light lamp = point_light({0.5, 2.4, 1.0}), red = sun(250, 45);
  lamp.intensity = 3.0f;
  lamp.range = 5.0;
  red.color = {1.0f, 0.2f, 0.1f};
  red.intensity = 0.4f;
  sets.push_back({lamp});
  sets.push_back({lights()[0], red});
  sets.push_back({red, lamp, lights()[2]});
  for (const std::vector<Light>& set : sets) {
    const std::unique_ptr<Technique> technique = make_technique("izb");
    Renderer renderer(scene, capabilities());
    renderer.prepare(*technique, width_px, height_px, set);
    gpu::StageTimers timers(true);
    renderer.render(camera, set, timers);
    std::vector<glm::vec4> picture(size_t(width_px) * height_px);
    renderer.picture().read_bytes(GL_RGBA, GL_FLOAT, picture.size() * sizeof(glm::vec4), picture.data());
    picture = flip_rows(std::move(picture), width_px, height_px);
    const bool suns =
        std::all_of(set.begin(), set.end(), [](const Light& l) { return l.type == LightType::directional; });
    double sum = 0.0;
    for (const Light& light : set) sum += double(light.intensity);
    const double exposure = suns ? 1.0 / sum : double(renderer.exposure());
    std::vector<Frame> frames;
    for (const Light& light : set)
      frames.push_back(render_frame(scene, camera, light, width_px, height_px, {{"spp", "32"}}));
    for (size_t k = 0; k < set.size(); ++k) EXPECT_EQ(different(renderer.read_mask(k), frames[k].mask), 0u) << k;
    size_t lit = 0, dark = 0;
    for (size_t i = 0; i < picture.size(); ++i) {
      if (frames[0].gbuffer.eye_distance[i] == 0.0f) continue;
      glm::dvec3 expected = unlit(frames[0], make_shade_frame(camera, set[0]), i);
      for (size_t k = 0; k < set.size(); ++k)
        expected += shaded(frames[k], set[k], double(set[k].intensity) * exposure, i);
      lit += frames[0].mask[i] == 0u, dark += frames[0].mask[i] != 0u;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(picture[i][k], expected[k], 3e-3 * (1.0 + expected[k])) << i;
    }
    EXPECT_GT(lit, 500u);
    EXPECT_GT(dark, 15u);
  }
}

TEST(Stages, CountsAndListsOfEachOfSeveralLightsAreThoseOfItAlone) {
  const Scene scene = box_on_a_floor();
  const std::vector<Light> set{lights()[0], point_light({0.5, 2.4, 1.0}), lights()[2]};
  // Removal races with the walks: what they meet would vary a little from run to run.
  const Settings settings{{"spp", "32"}, {"removal", "off"}, {"unchanged-skip", "off"}};
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set_options(*technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, set);
  gpu::StageTimers timers(true);
  renderer.render(camera, set, timers);
  for (size_t i = 0; i < set.size(); ++i) {
    Renderer alone(scene, capabilities());
    const std::unique_ptr<Technique> its = make_technique("izb");
    set_options(*its, settings);
    alone.prepare(*its, width_px, height_px, {set[i]});
    alone.render(camera, {set[i]}, timers);
    EXPECT_EQ(renderer.count(i), alone.count()) << i;
    EXPECT_EQ(renderer.list_lengths(i), alone.list_lengths()) << i;
    EXPECT_EQ(different(renderer.read_mask(i), alone.read_mask()), 0u) << i;
  }
}

}  // namespace
}  // namespace izb::test

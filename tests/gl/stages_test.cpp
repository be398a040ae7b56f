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
    const float side = float(frame.inputs.light.grid.x);
    EXPECT_NEAR((low.x - got.window.x) * got.window.z, 1.0f, 0.05f);
    EXPECT_NEAR((high.y - got.window.y) * got.window.w, side - 1.0f, 0.05f);
  }
}

/// Final render of a receiver without a shading normal, white but for a missing green.
glm::dvec3 shaded(const Frame& frame, const shared::ShadeFrame& shade, size_t i) {
  const shared::LightFrame& light = frame.inputs.light;
  const glm::dvec3 p = frame.receivers.points_vs[i], albedo(1.0, 0.0, 1.0);
  const glm::dvec3 n = glm::normalize(glm::dvec3(shared::octahedral_direction(frame.gbuffer.normal[i])));
  const glm::dvec3 up = glm::vec3(shade.up_vs), ground = glm::vec3(shade.ground), zenith = glm::vec3(shade.sky_zenith);
  glm::dvec3 color = albedo * double(shade.up_vs.w) * glm::mix(ground, zenith, 0.5 + 0.5 * glm::dot(n, up));
  if (frame.receivers.classes[i] != reference::PixelClass::receiver) return color;
  const bool positional = shared::is_positional(light);
  const glm::dvec3 to_light =
      positional ? glm::normalize(glm::dvec3(glm::vec3(light.origin)) - p) : glm::dvec3(glm::vec3(light.to_light));
  double cone = 1.0;
  if (positional) {
    const double along = -glm::dot(glm::dvec3(glm::vec3(light.axis_z)), to_light);
    const double x = std::clamp((along - shade.cone.y) / double(shade.cone.x - shade.cone.y), 0.0, 1.0);
    cone = x * x * (3.0 - 2.0 * x);
  }
  const double visibility = 1.0 - std::popcount(frame.mask[i]) / 32.0, diffuse = std::max(glm::dot(n, to_light), 0.0);
  const glm::dvec3 halfway = glm::normalize(to_light - glm::normalize(p));
  const double specular = diffuse > 0.0 ? 0.04 * std::pow(std::max(glm::dot(n, halfway), 0.0), 32.0) : 0.0;
  return color + glm::dvec3(glm::vec3(light.color)) * (cone * visibility) * (albedo * diffuse + specular);
}

TEST(Stages, ShadeIsPhongWithTheMask) {
  Scene scene = box_on_a_floor();
  scene.materials[0].base_color = {1.0f, 0.0f, 1.0f, 1.0f};  // exact in eight bits
  for (const Light& light : lights()) {
    const Frame frame = render_frame(scene, camera, light, width_px, height_px, {{"spp", "32"}});
    const std::unique_ptr<Technique> technique = make_technique("izb");
    Renderer renderer(scene, capabilities());
    renderer.prepare(*technique, width_px, height_px);
    gpu::StageTimers timers(true);
    renderer.render(camera, light, timers);
    std::vector<glm::vec4> picture(frame.mask.size());
    renderer.picture().read_bytes(GL_RGBA, GL_FLOAT, picture.size() * sizeof(glm::vec4), picture.data());
    picture = flip_rows(std::move(picture), width_px, height_px);
    const shared::ShadeFrame shade = make_shade_frame(camera, light);
    size_t lit = 0, dark = 0;
    for (size_t i = 0; i < picture.size(); ++i) {
      if (frame.gbuffer.eye_distance[i] == 0.0f) continue;
      const glm::dvec3 expected = shaded(frame, shade, i);
      lit += frame.mask[i] == 0u, dark += frame.mask[i] != 0u;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(picture[i][k], expected[k], 2e-3 * (1.0 + expected[k])) << i;
    }
    EXPECT_GT(lit, 500u);
    EXPECT_GT(dark, 15u);
  }
}

}  // namespace
}  // namespace izb::test

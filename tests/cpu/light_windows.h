// SPDX-License-Identifier: MIT
// Random lights with windows, and the grid of such a window in double, independently of the shared text.
#pragma once
#include "shared/bounds.h"
#include "shared_fixture.h"

namespace izb::test {

struct Setting {
  shared::LightFrame light;
  shared::LightWindow window;
};

/// A window over random receivers, made by the stage's own text.
inline Setting random_setting(Random& random, bool positional, double reach) {
  const glm::dvec3 lamp = random.point(reach);
  Setting s;
  s.light = make_light(random.direction(), positional ? &lamp : nullptr, 64u << random.below(6));
  shared::ReceiverBounds bounds{glm::uvec4(~0u), glm::uvec4(0u), glm::uvec4(0u)};
  const glm::dvec3 center = random.point(reach);
  for (int i = 0; i < 50; ++i) {
    glm::dvec3 p = center + random.point(reach * 0.2);
    if (positional) {  // inside a cone of 45 degrees
      const glm::dvec3 z = glm::vec3(s.light.axis_z), x = glm::vec3(s.light.axis_x), y = glm::vec3(s.light.axis_y);
      const double far = reach * random.uniform(0.05, 1.0);
      p = lamp + z * far + x * far * random.uniform(-0.7, 0.7) + y * far * random.uniform(-0.7, 0.7);
    }
    const glm::vec3 p_vs(p);
    const glm::vec3 p_ls = shared::light_position(s.light, p_vs);
    if (positional && p_ls.z <= 0.0f) continue;
    const glm::vec3 uvd = shared::light_uvd(s.light, p_ls);
    for (int k = 0; k < 3; ++k) {
      bounds.low[k] = std::min(bounds.low[k], shared::ordered_from_float(uvd[k]));
      bounds.high[k] = std::max(bounds.high[k], shared::ordered_from_float(uvd[k]));
    }
    bounds.slack.x = std::max(bounds.slack.x, shared::ordered_from_float(shared::uv_error(s.light, p_vs, p_ls)));
    bounds.slack.y = std::max(bounds.slack.y, shared::ordered_from_float(shared::d_error(s.light, p_vs, p_ls)));
    ++bounds.slack.z;
  }
  s.window = shared::make_window(s.light, bounds);
  return s;
}

/// Grid position and depth in double, through the window's own numbers; z of the light space in w.
inline glm::dvec4 exact_grid(const Setting& s, const glm::dvec3& p_vs) {
  const glm::dvec3 p = p_vs - glm::dvec3(glm::vec3(s.light.origin));
  const glm::dvec3 ls(glm::dot(glm::dvec3(glm::vec3(s.light.axis_x)), p),
                      glm::dot(glm::dvec3(glm::vec3(s.light.axis_y)), p),
                      glm::dot(glm::dvec3(glm::vec3(s.light.axis_z)), p));
  const bool positional = shared::is_positional(s.light);
  const glm::dvec3 uvd = positional ? glm::dvec3(ls.x / ls.z, ls.y / ls.z, -1.0 / ls.z) : ls;
  const glm::dvec4 w(s.window.window);
  return {(uvd.x - w.x) * w.z, (uvd.y - w.y) * w.w, double(s.window.depth.x) + double(s.window.depth.y) * uvd.z, ls.z};
}

}  // namespace izb::test

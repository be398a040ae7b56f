// SPDX-License-Identifier: MIT
// Looks of the G-buffer and of the mask.
#include "view/look_pictures.h"

#include <bit>
#include <cmath>

#include "image/srgb.h"
#include "view/color_scale.h"
#include "view/light_space.h"

namespace izb::draw {
namespace {

/// A picture in which color(i) gives each pixel that is not sky its colour.
template <typename Color>
LookPicture of_surfaces(const Snapshot& s, Color&& color) {
  LookPicture look{blank(s.width_px, s.height_px), {}, {}};
  for (size_t i = 0; i < s.size(); ++i)
    if (s.gbuffer.eye_distance[i] > 0.0f) put(look.picture, i, color(i));
  return look;
}

Rgb grey(float value) {
  return dimmed({255, 255, 255}, value);
}

/// A unit vector of view space by its world-space coordinates, so that colours stay when the camera turns.
Rgb direction_color(const Snapshot& s, const glm::vec3& direction_vs) {
  if (direction_vs == glm::vec3(0.0f)) return nothing_color;
  const glm::dvec3 n = glm::normalize(glm::dmat3(s.camera_ws.world_from_view) * glm::dvec3(direction_vs));
  Rgb color;
  for (int k = 0; k < 3; ++k) color[size_t(k)] = static_cast<uint8_t>(std::lround(127.5 + 127.5 * n[k]));
  return color;
}

glm::vec3 normal_vs(const Snapshot& s, size_t i) {
  return shared::octahedral_direction(s.gbuffer.normal[i]);
}

constexpr Rgb receiver_color{250, 225, 140}, culled_color{60, 75, 150}, outside_cone_color{130, 50, 120};
constexpr Rgb leak_color{255, 75, 30}, false_shadow_color{50, 160, 255};

}  // namespace

float dim_grey(const Snapshot& s, size_t i) {
  const glm::vec3 p = receiver_point_vs(s.gbuffer, s.camera, i), n = normal_vs(s, i);
  if (n == glm::vec3(0.0f)) return 0.15f;
  const glm::vec3 view = shared::is_perspective(s.camera) ? glm::normalize(p) : glm::vec3(0.0f, 0.0f, -1.0f);
  return 0.15f + 0.35f * std::min(std::abs(glm::dot(glm::normalize(n), view)), 1.0f);
}

LookPicture depth(const Snapshot& s, int) {
  std::vector<float> values;
  for (const float t : s.gbuffer.eye_distance)
    if (t > 0.0f) values.push_back(t);
  const ColorScale scale = log_scale_of(std::move(values));
  LookPicture look = of_surfaces(s, [&](size_t i) { return scale.color(s.gbuffer.eye_distance[i]); });
  look.low = with_unit(scale.low, "m");
  look.high = with_unit(scale.high, "m");
  return look;
}

LookPicture normal(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) { return direction_color(s, normal_vs(s, i)); });
}

// As shading takes it: on the viewer's side, and where a pixel has none, the geometric one.
LookPicture shading_normal(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const glm::vec3 geometric = normal_vs(s, i), &n = s.shading_normal[i];
    return direction_color(s, n == glm::vec3(0.0f) ? geometric : glm::dot(n, geometric) < 0.0f ? -n : n);
  });
}

LookPicture albedo(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const glm::vec3& a = s.albedo[i];
    return Rgb{to_srgb8(a.x), to_srgb8(a.y), to_srgb8(a.z)};
  });
}

LookPicture triangle(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const glm::uvec2& id = s.gbuffer.id[i];
    return hashed_color(id.x * 0x01000193u ^ id.y);
  });
}

LookPicture instance(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) { return hashed_color(s.gbuffer.id[i].x); });
}

LookPicture light_class(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const uint32_t its = class_of(s, i);
    const Rgb& color = its == shared::class_receiver ? receiver_color
                       : its == shared::class_culled ? culled_color
                                                     : outside_cone_color;
    return dimmed(color, 0.4f + 1.2f * dim_grey(s, i));
  });
}

LookPicture visibility(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    if (class_of(s, i) != shared::class_receiver) return dimmed(culled_color, 0.5f);
    return grey(1.0f - float(std::popcount(s.mask[i])) / 32.0f);
  });
}

LookPicture errors(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const int leaks = std::popcount(s.truth[i] & ~s.mask[i]), falsely = std::popcount(s.mask[i] & ~s.truth[i]);
    const int wrong = std::max(leaks, falsely);
    if (wrong == 0) return grey(dim_grey(s, i) * (1.0f - 0.6f * float(std::popcount(s.truth[i])) / 32.0f));
    return dimmed(leaks >= falsely ? leak_color : false_shadow_color, 0.6f + 0.4f * float(wrong) / 32.0f);
  });
}

LookPicture cascade(const Snapshot& s, int) {
  return of_surfaces(s, [&](size_t i) {
    const float shade = dim_grey(s, i);
    if (class_of(s, i) != shared::class_receiver) return grey(0.6f * shade);
    return dimmed(distinct_color(static_cast<uint32_t>(layer_of(s, i))), std::min(1.9f * shade, 1.0f));
  });
}

}  // namespace izb::draw

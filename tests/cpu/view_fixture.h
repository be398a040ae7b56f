// SPDX-License-Identifier: MIT
// Snapshots made by hand, of which every answer is known.
#pragma once
#include "image/image.h"
#include "shared_fixture.h"
#include "view/snapshot.h"

namespace izb::test {

/// An orthographic camera 10 m above a floor that it sees straight on, with pixels of 1 m, so that view space has its
/// origin at the picture's lower left corner. Under a sun from the viewer: the grid's texel (x, y) is the pixel (x, y)
/// from the bottom, with a border of one texel. No triangle is there.
inline Snapshot floor_from_above(int width_px, int height_px) {
  Snapshot s;
  s.width_px = s.gbuffer.width_px = width_px;
  s.height_px = s.gbuffer.height_px = height_px;
  s.camera = {};
  s.camera.pixel_ray = glm::vec4(1, 1, 0, 0);
  s.camera.footprint = glm::vec4(0, 1, 0, 0);
  s.camera.size_px = glm::uvec4(width_px, height_px, 0, 0);
  s.samples = halton_samples();
  s.light = make_light({0, 0, -1}, nullptr, 16);
  s.light.axis_x = glm::vec4(1, 0, 0, 0);
  s.light.axis_y = glm::vec4(0, 1, 0, 0);
  s.light.grid = glm::uvec4(16, 1, 1, 0);
  const size_t count = size_t(width_px) * size_t(height_px);
  s.gbuffer.eye_distance.assign(count, 10.0f);
  s.gbuffer.normal.assign(count, shared::octahedral_encode(glm::vec3(0, 0, 1)));
  s.gbuffer.id.assign(count, glm::uvec2(0));
  s.gbuffer.micro_quad.assign(count, glm::vec4(10, 0, 0, 1));
  s.windows.push_back({glm::vec4(-1, -1, 1, 1), glm::vec4(-2.0f, 0.25f, 0, 0), glm::vec4(0, 16, 0, 0)});
  s.cascades = {};
  return s;
}

/// The pixel of view-space x and y, as the picture has it.
inline std::array<uint8_t, 3> color_at(const Image8& picture, int x, int y) {
  const uint8_t* c = &picture.pixels.at(3 * (size_t(y) * size_t(picture.width_px) + size_t(x)));
  return {c[0], c[1], c[2]};
}

}  // namespace izb::test

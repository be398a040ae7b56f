// SPDX-License-Identifier: MIT
// GPU results on the CPU, top row first as files have them.
#pragma once
#include <algorithm>
#include <vector>

#include "frame/gbuffer.h"

namespace izb {

template <typename T>
std::vector<T> flip_rows(std::vector<T> rows, int width_px, int height_px) {
  for (int y = 0; y < height_px / 2; ++y)
    std::swap_ranges(rows.begin() + size_t(y) * width_px, rows.begin() + size_t(y + 1) * width_px,
                     rows.begin() + size_t(height_px - 1 - y) * width_px);
  return rows;
}

/// What later checks need of the G-buffer, top row first.
struct GBufferImage {
  int width_px = 0, height_px = 0;
  std::vector<float> eye_distance;
  std::vector<glm::vec2> normal;  ///< octahedral
  std::vector<glm::uvec2> id;
  std::vector<glm::vec4> micro_quad;  ///< shared::micro_quad_data; empty at one sample a pixel

  /// The pixel's centre in the shaders' coordinates, which count from the bottom.
  glm::vec2 center_px(size_t i) const {
    return {float(i % width_px) + 0.5f, float(height_px - 1 - int(i / width_px)) + 0.5f};
  }
  size_t size() const { return eye_distance.size(); }
};

GBufferImage read_gbuffer(const GBuffer& gbuffer);

/// The mask's words.
std::vector<uint32_t> read_mask(const gpu::Texture& mask);

/// The receiver point of pixel i in view space, by the shaders' own text.
glm::vec3 receiver_point_vs(const GBufferImage& image, const shared::CameraFrame& camera, size_t i);
/// The centre of its micro-quad: the same, unless that is lifted.
glm::vec3 quad_center_vs(const GBufferImage& image, const shared::CameraFrame& camera, size_t i);

/// shared::class_... of pixel i.
uint32_t pixel_class(const GBufferImage& image, const shared::CameraFrame& camera, const shared::LightFrame& light,
                     size_t i);

}  // namespace izb

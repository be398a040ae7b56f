// SPDX-License-Identifier: MIT
#include "app/bench/lit_share.h"

#include <bit>
#include <cmath>

#include "frame/read_back.h"

namespace izb::bench {

std::vector<uint8_t> receivers_of(const Renderer& renderer) {
  const FrameInputs& in = renderer.inputs();
  const GBufferImage gbuffer = read_gbuffer(*in.gbuffer);
  std::vector<uint8_t> receivers(gbuffer.size());
  for (size_t i = 0; i < receivers.size(); ++i)
    receivers[i] = pixel_class(gbuffer, in.camera, in.light, i) == shared::class_receiver;
  return receivers;
}

std::vector<uint8_t> flat_pixels(const Renderer& renderer) {
  const FrameInputs& in = renderer.inputs();
  const GBufferImage gbuffer = read_gbuffer(*in.gbuffer);
  std::vector<uint8_t> flat(gbuffer.size(), 0);
  std::vector<glm::vec3> points_vs(gbuffer.size());
  for (size_t i = 0; i < points_vs.size(); ++i) points_vs[i] = receiver_point_vs(gbuffer, in.camera, i);
  for (int y = 1; y + 1 < in.height_px; ++y)
    for (int x = 1; x + 1 < in.width_px; ++x) {
      const size_t i = size_t(y) * size_t(in.width_px) + size_t(x);
      if (gbuffer.eye_distance[i] <= 0.0f) continue;
      const glm::vec3 normal = shared::octahedral_direction(gbuffer.normal[i]);
      const float most = 1.0f / 64.0f * shared::pixel_width(in.camera, gbuffer.eye_distance[i]);
      bool all = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const size_t k = size_t(y + dy) * size_t(in.width_px) + size_t(x + dx);
          all =
              all && gbuffer.eye_distance[k] > 0.0f && std::abs(glm::dot(points_vs[k] - points_vs[i], normal)) <= most;
        }
      flat[i] = all;
    }
  return flat;
}

std::vector<float> lit_share(const Renderer& renderer) {
  const std::vector<uint32_t> mask = renderer.read_mask();
  const std::vector<uint8_t> receivers = receivers_of(renderer);
  std::vector<float> lit(mask.size());
  for (size_t i = 0; i < lit.size(); ++i) lit[i] = receivers[i] ? 1.0f - float(std::popcount(mask[i])) / 32.0f : 0.0f;
  return lit;
}

}  // namespace izb::bench

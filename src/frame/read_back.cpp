// SPDX-License-Identifier: MIT
#include "frame/read_back.h"

namespace izb {

GBufferImage read_gbuffer(const GBuffer& gbuffer) {
  GBufferImage image;
  image.width_px = gbuffer.id.width_px();
  image.height_px = gbuffer.id.height_px();
  const auto top_first = [&](auto rows) { return flip_rows(std::move(rows), image.width_px, image.height_px); };
  image.eye_distance = top_first(gbuffer.eye_distance.read<float>(GL_RED, GL_FLOAT, 1));
  std::vector<glm::vec2> normals(image.eye_distance.size());
  gbuffer.normal.read_bytes(GL_RG, GL_FLOAT, normals.size() * sizeof(glm::vec2), normals.data());
  image.normal = top_first(std::move(normals));
  std::vector<glm::uvec2> ids(image.eye_distance.size());
  gbuffer.id.read_bytes(GL_RG_INTEGER, GL_UNSIGNED_INT, ids.size() * sizeof(glm::uvec2), ids.data());
  image.id = top_first(std::move(ids));
  if (gbuffer.micro_quad) {
    std::vector<glm::vec4> quads(image.eye_distance.size());
    gbuffer.micro_quad.read_bytes(GL_RGBA, GL_FLOAT, quads.size() * sizeof(glm::vec4), quads.data());
    image.micro_quad = top_first(std::move(quads));
  }
  return image;
}

std::vector<uint32_t> read_mask(const gpu::Texture& mask) {
  return flip_rows(mask.read_uint(), mask.width_px(), mask.height_px());
}

glm::vec3 receiver_point_vs(const GBufferImage& image, const shared::CameraFrame& camera, size_t i) {
  return shared::receiver_point(camera, image.center_px(i), image.eye_distance[i]);
}

glm::vec3 quad_center_vs(const GBufferImage& image, const shared::CameraFrame& camera, size_t i) {
  if (image.micro_quad.empty()) return receiver_point_vs(image, camera, i);
  return shared::receiver_point(camera, image.center_px(i), image.micro_quad[i].x);
}

uint32_t pixel_class(const GBufferImage& image, const shared::CameraFrame& camera, const shared::LightFrame& light,
                     size_t i) {
  if (!(image.eye_distance[i] > 0.0f)) return shared::class_sky;
  return shared::receiver_class(light, receiver_point_vs(image, camera, i),
                                shared::octahedral_direction(image.normal[i]));
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "shadow/ray_traced/receivers.h"

namespace izb {

reference::Receivers make_receivers(const GBufferImage& image, const FrameInputs& in) {
  constexpr float band_px = 1.0f / 64.0f;
  reference::Receivers receivers;
  const size_t count = image.size();
  receivers.width_px = image.width_px;  // packets of rays cover tiles of pixels
  receivers.points_vs.resize(count);
  receivers.own_triangle.assign(count, 0xffffffffu);
  receivers.classes.resize(count);
  receivers.band.resize(count);
  for (size_t i = 0; i < count; ++i) {
    receivers.points_vs[i] = receiver_point_vs(image, in.camera, i);
    receivers.classes[i] = static_cast<reference::PixelClass>(pixel_class(image, in.camera, in.light, i));
    receivers.band[i] = band_px * shared::pixel_width(in.camera, image.eye_distance[i]);
    if (image.id[i].x != 0) receivers.own_triangle[i] = (*in.first_triangle)[image.id[i].x - 1] + image.id[i].y;
  }
  return receivers;
}

reference::LightPoint make_light_point(const shared::LightFrame& light) {
  const bool positional = shared::is_positional(light);
  return {positional ? glm::vec3(light.origin) : glm::vec3(light.to_light), positional};
}

}  // namespace izb

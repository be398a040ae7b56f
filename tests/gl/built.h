// SPDX-License-Identifier: MIT
// A small frame and its irregular z-buffer, read back: for tests of single stages of the technique `izb`.
#pragma once
#include <algorithm>

#include "gl/frame_fixture.h"
#include "shadow/izb/izb.h"
#include "shared/faces.h"

namespace izb::test::built {

inline constexpr int width_px = 96, height_px = 64;
inline const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));

inline std::vector<Light> lights() {
  return {sun(130, 35), sun(20, 60), spot({1, 5, 2}, {0, 0, 0}, 55), point_light({0.4, 1.7, 0.9})};
}

/// Where a node stands, and which.
struct Place {
  glm::ivec2 texel;
  int layer, slot;
};

/// A frame and its irregular z-buffer.
struct Built {
  Frame frame;
  IzbInternals izb;

  /// Every receiver has nodes: without occluders.
  Built(const Scene& scene, const Light& light, const Settings& settings, int stride = 1) {
    Izb technique;
    technique.settings().insertion_stride = stride;
    frame = render_frame(scene, camera, light, width_px, height_px, with({{"occluders", "off"}}, settings), technique);
    izb = technique.internals();
  }

  const shared::LightFrame& light() const { return frame.inputs.light; }
  bool receiver(size_t i) const { return frame.receivers.classes[i] == reference::PixelClass::receiver; }
  int cascades() const { return int(light().grid.y); }
  /// The face through which the light sees the pixel's centre.
  int face(size_t i) const {
    if (light().grid.z == 1) return 0;
    return shared::face_of(shared::light_position(light(), frame.receivers.points_vs[i]));
  }
  int layer_at(size_t i, int face) const {
    return face * cascades() + shared::cascade_of(frame.range, cascades(), frame.gbuffer.eye_distance[i]);
  }
  int layer(size_t i) const { return layer_at(i, face(i)); }
  shared::LightFrame face_light(size_t i) const { return shared::light_face(light(), face(i)); }
  const shared::LightWindow& window(size_t i) const { return frame.windows[size_t(layer(i))]; }
  /// Whether that face sees all of the micro-quad.
  bool whole(size_t i) const { return light().grid.z == 1 || shared::quad_part(light(), quad(i), face(i)).whole; }
  /// Of a pixel in the frame's images, top row first.
  static size_t index(uint32_t node) {
    const glm::ivec2 px = shared::pixel_from_node(node);
    return size_t(height_px - 1 - px.y) * width_px + px.x;
  }

  /// Grid position and depth of a pixel's centre.
  glm::vec3 position(size_t i) const {
    return shared::grid_position(
        window(i), shared::light_uvd(light(), shared::light_position(face_light(i), frame.receivers.points_vs[i])));
  }
  shared::MicroQuad quad(size_t i) const {
    return shared::make_micro_quad(frame.inputs.camera, glm::ivec2(frame.gbuffer.center_px(i)),
                                   frame.gbuffer.micro_quad[i]);
  }
  shared::QuadPart part(size_t i, int face) const {
    return light().grid.z == 1 ? shared::whole_quad(light(), quad(i)) : shared::quad_part(light(), quad(i), face);
  }
  /// Texels by which its points may be off.
  float guard(size_t i) const { return shared::quad_guard(window(i), part(i, layer(i) / cascades())); }
  glm::vec3 grid_position(size_t i, const glm::vec2& offset_px) const {
    return shared::grid_position(window(i), shared::micro_quad_uvd(face_light(i), quad(i), offset_px));
  }
  glm::ivec2 texel(size_t i, const glm::vec2& offset_px) const {
    return shared::grid_texel(window(i), grid_position(i, offset_px));
  }
  /// Depth of the pixel's node in that layer as `furthest` counts it.
  float depth(size_t i, int layer) const {
    if (frame.gbuffer.micro_quad.empty()) return position(i).z + window(i).depth.z;
    const int f = layer / cascades();
    const shared::LightFrame its = shared::light_face(light(), f);
    return shared::part_on_grid(its, frame.windows[size_t(layer)], quad(i), part(i, f)).deepest;
  }

  /// Visits (at, layer, list) for each texel of each grid.
  template <typename Visit>
  void for_each_texel(Visit&& visit) const {
    for (int layer = 0; layer < izb.layers; ++layer)
      for (int y = 0; y < izb.grid; ++y)
        for (int x = 0; x < izb.grid; ++x) visit(glm::ivec2(x, y), layer, izb.lists[izb.texel({x, y}, layer)]);
  }

  /// Where each pixel's nodes stand, by slot, then by texel.
  std::vector<std::vector<Place>> places() const {
    std::vector<std::vector<Place>> all(frame.mask.size());
    for_each_texel([&](const glm::ivec2& at, int layer, std::span<const uint32_t> list) {
      for (const uint32_t node : list) all[index(node)].push_back({at, layer, shared::slot_from_node(node)});
    });
    for (std::vector<Place>& places : all)
      std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.slot < b.slot; });
    return all;
  }
};

}  // namespace izb::test::built

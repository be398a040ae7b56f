// SPDX-License-Identifier: MIT
#include "view/light_space.h"

#include <algorithm>
#include <stdexcept>

#include "shared/lists.h"

namespace izb {
namespace {

int cascades_of(const shared::LightFrame& light) {
  return static_cast<int>(light.grid.y);
}

const IzbInternals& built(const Snapshot& snapshot) {
  if (!snapshot.built) throw std::logic_error("the snapshot has no lists");
  return *snapshot.built;
}

glm::dvec3 from_light_space(const shared::LightFrame& face, const glm::dvec3& p_ls) {
  return glm::dvec3(face.origin) + glm::dvec3(face.axis_x) * p_ls.x + glm::dvec3(face.axis_y) * p_ls.y +
         glm::dvec3(face.axis_z) * p_ls.z;
}

/// The inverse of shared::grid_position and light_uvd.
glm::dvec3 light_space_of(const shared::LightFrame& face, const shared::LightWindow& w, const glm::dvec3& grid) {
  const glm::dvec3 uvd(double(w.window.x) + grid.x / double(w.window.z),
                       double(w.window.y) + grid.y / double(w.window.w),
                       (grid.z - double(w.depth.x)) / double(w.depth.y));
  if (!shared::is_positional(face)) return uvd;
  const double z = -1.0 / uvd.z;
  return {uvd.x * z, uvd.y * z, z};
}

}  // namespace

uint32_t class_of(const Snapshot& s, size_t i) {
  return pixel_class(s.gbuffer, s.camera, s.light, i);
}

glm::ivec2 shader_px(const Snapshot& s, size_t i) {
  return glm::ivec2(s.gbuffer.center_px(i));
}

int layer_of(const Snapshot& s, size_t i) {
  const int cascades = cascades_of(s.light);
  const int cascade = shared::cascade_of(s.cascades, cascades, s.gbuffer.eye_distance[i]);
  if (s.light.grid.z <= 1) return cascade;
  const glm::vec3 p_ls = shared::light_position(s.light, receiver_point_vs(s.gbuffer, s.camera, i));
  return shared::face_of(p_ls) * cascades + cascade;
}

shared::LightFrame face_of_layer(const Snapshot& s, int layer) {
  return shared::light_face(s.light, layer / cascades_of(s.light));
}

shared::QuadOnGrid quad_on_grid(const Snapshot& s, size_t i) {
  const int layer = layer_of(s, i);
  const shared::MicroQuad quad = shared::make_micro_quad(s.camera, shader_px(s, i), s.gbuffer.micro_quad[i]);
  return shared::project_quad(face_of_layer(s, layer), s.windows[size_t(layer)], quad);
}

std::vector<std::array<glm::dvec3, 8>> cascade_frusta_ws(const Snapshot& s) {
  const glm::dmat4& world_from_view = s.camera_ws.world_from_view;
  std::vector<std::array<glm::dvec3, 8>> frusta(s.windows.size());
  for (size_t layer = 0; layer < frusta.size(); ++layer) {
    const shared::LightWindow& w = s.windows[layer];
    const double side = double(w.guard.y);
    if (side == 0.0) {
      frusta[layer].fill(glm::dvec3(world_from_view[3]));
      continue;
    }
    const shared::LightFrame face = face_of_layer(s, static_cast<int>(layer));
    for (unsigned corner = 0; corner < 8; ++corner) {
      // Depths of receivers lie in [1/4, 3/4].
      const glm::dvec3 grid((corner & 1u) != 0 ? side : 0.0, (corner & 2u) != 0 ? side : 0.0,
                            (corner & 4u) != 0 ? 0.75 : 0.25);
      const glm::dvec3 p_vs = from_light_space(face, light_space_of(face, w, grid));
      frusta[layer][corner] = glm::dvec3(world_from_view * glm::dvec4(p_vs, 1.0));
    }
  }
  return frusta;
}

std::vector<glm::ivec2> pixels_of_texel(const Snapshot& s, const glm::ivec2& texel, int layer) {
  const IzbInternals& izb = built(s);
  std::vector<glm::ivec2> pixels;
  for (const uint32_t node : izb.lists[izb.texel(texel, layer)]) {
    const glm::ivec2 px = shared::pixel_from_node(node);
    pixels.emplace_back(px.x, s.height_px - 1 - px.y);
  }
  std::sort(pixels.begin(), pixels.end(),
            [](const auto& a, const auto& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

std::vector<std::pair<int, glm::ivec2>> texels_of_pixel(const Snapshot& s, const glm::ivec2& px) {
  const IzbInternals& izb = built(s);
  constexpr uint32_t pixel_bits = (1u << 29) - 1;
  const uint32_t wanted = shared::node_from_pixel({px.x, s.height_px - 1 - px.y}, 0);
  std::vector<std::pair<int, glm::ivec2>> texels;
  for (size_t n = 0; n < izb.lists.nodes.size(); ++n) {
    if ((izb.lists.nodes[n] & pixel_bits) != wanted) continue;
    const auto& first = izb.lists.first;
    const size_t texel = size_t(std::upper_bound(first.begin(), first.end(), n) - first.begin()) - 1;
    const size_t a_layer = size_t(izb.grid) * size_t(izb.grid), in_layer = texel % a_layer;
    const std::pair<int, glm::ivec2> found(
        static_cast<int>(texel / a_layer),
        glm::ivec2(static_cast<int>(in_layer % size_t(izb.grid)), static_cast<int>(in_layer / size_t(izb.grid))));
    if (texels.empty() || texels.back() != found) texels.push_back(found);
  }
  return texels;
}

}  // namespace izb

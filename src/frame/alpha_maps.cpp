// SPDX-License-Identifier: MIT
#include "frame/alpha_maps.h"

#include <limits>

#include "base/error.h"
#include "shared/alpha.h"

namespace izb {
namespace {

/// What a material without a texture reads: one texel of full alpha, the first of all.
constexpr uint32_t plain_size = 1u | 1u << 16;

uint32_t wrap_bits(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return shared::wrap_repeat;
    case Wrap::mirrored_repeat:
      return shared::wrap_mirrored;
    default:
      return shared::wrap_clamp;
  }
}

}  // namespace

AlphaMaps plan_alpha_maps(const Scene& scene) {
  constexpr int largest_side = 0xffff;
  AlphaMaps maps;
  maps.of_material.assign(scene.materials.size(), glm::uvec4(0u));
  std::vector<int64_t> first(scene.textures.size(), -1);
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!material.masked()) continue;
    if (maps.texel_count == 0) maps.texel_count = 1;
    glm::uvec4& map = maps.of_material[m];
    map = {0u, plain_size, shared::alpha_masked_bit, 0u};
    if (material.base_color_texture < 0) continue;
    const size_t index = static_cast<size_t>(material.base_color_texture);
    const Texture& t = scene.textures[index];
    if (std::max(t.width_px, t.height_px) > largest_side)
      fail("the alpha mask of material '{}' is {} x {} texels; {} a side are the most", material.name, t.width_px,
           t.height_px, largest_side);
    if (first[index] < 0) {
      first[index] = static_cast<int64_t>(maps.texel_count);
      maps.texel_count += uint64_t(t.width_px) * uint64_t(t.height_px);
      if (maps.texel_count > uint64_t(std::numeric_limits<int32_t>::max()))
        fail("the alpha masks of scene '{}' have more than 2^31 texels: take a smaller scene", scene.name);
    }
    map.x = static_cast<uint32_t>(first[index]);
    map.y = static_cast<uint32_t>(t.width_px) | static_cast<uint32_t>(t.height_px) << 16;
    map.z |= wrap_bits(t.wrap_u) | wrap_bits(t.wrap_v) << 2 | (t.nearest ? shared::alpha_nearest_bit : 0u);
  }
  return maps;
}

std::vector<uint8_t> join_alpha_maps(const Scene& scene, const AlphaMaps& maps) {
  std::vector<uint8_t> texels(maps.texel_count);
  if (texels.empty()) return texels;
  texels[0] = 255;
  std::vector<bool> copied(scene.textures.size());
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    const int index = scene.materials[m].base_color_texture;
    if (!scene.materials[m].masked() || index < 0 || copied[static_cast<size_t>(index)]) continue;
    copied[static_cast<size_t>(index)] = true;
    const Texture& t = scene.textures[static_cast<size_t>(index)];
    uint8_t* const to = &texels[maps.of_material[m].x];
    for (size_t i = 0; i < size_t(t.width_px) * size_t(t.height_px); ++i) to[i] = t.rgba[4 * i + 3];
  }
  return texels;
}

}  // namespace izb

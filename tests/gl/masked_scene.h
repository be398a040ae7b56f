// SPDX-License-Identifier: MIT
// Scenes with alpha-masked casters, made by code.
#pragma once
#include "gl/frame_fixture.h"

namespace izb::test {

inline Texture blots(uint32_t seed, int texture_width, int texture_height, Wrap wrap_u, Wrap wrap_v, bool nearest) {
  Random random(seed);
  Texture t;
  t.name = "blots";
  t.width_px = texture_width, t.height_px = texture_height;
  t.wrap_u = wrap_u, t.wrap_v = wrap_v, t.nearest = nearest;
  for (int i = 0; i < texture_width * texture_height; ++i)
    t.rgba.insert(t.rgba.end(), {200, 180, 90, static_cast<uint8_t>(random.below(256))});
  return t;
}

/// The mesh's material becomes a masked one; texture coordinates at random, some texels wide to many times the texture.
inline void mask_mesh(Scene& scene, size_t mesh, uint32_t seed, const Texture& texture) {
  Random random(seed);
  scene.textures.push_back(texture);
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture = static_cast<int>(scene.textures.size() - 1);
  material.base_color.a = 0.95f;
  material.alpha_cutoff = 0.45f;
  material.uv_transform = glm::mat3(0.8f, 0.3f, 0, -0.3f, 0.8f, 0, 0.2f, -0.7f, 1);
  scene.meshes[mesh].material = static_cast<uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  for (size_t i = 0; i < scene.meshes[mesh].positions.size(); ++i)
    scene.meshes[mesh].uvs.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2));
}

/// A floor, opaque triangles, and masked ones of both filters.
inline Scene masked_tangle(uint32_t seed) {
  Scene scene = tangle(seed, 100);
  for (uint32_t part = 0; part < 2; ++part) {
    const Scene more = tangle(seed + 100 + part, 120);
    scene.meshes.push_back(more.meshes[1]);
    scene.instances.push_back({static_cast<uint32_t>(scene.meshes.size() - 1), glm::dmat4(1.0)});
    mask_mesh(scene, scene.meshes.size() - 1, seed + part,
              part == 0 ? blots(seed, 9, 5, Wrap::repeat, Wrap::mirrored_repeat, false)
                        : blots(seed, 4, 16, Wrap::clamp_to_edge, Wrap::repeat, true));
  }
  return scene;
}

}  // namespace izb::test

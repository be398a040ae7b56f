// SPDX-License-Identifier: MIT
// Scenes that are made by code: the same seed gives the same scene on every machine.
#pragma once
#include <cstdint>
#include <span>

#include "scene/scene.h"

namespace izb {

/// A walled garden at sunset, made to show what alias-free hard shadows are for: wires, spokes, grass,
/// lattices, a curved body, sharp contacts and long grazing shadows. World y up, metres, paving at y = 0; 100
/// to 300 thousand triangles placed. Cameras "main", "wires", "grass", "contact"; one directional light
/// "sunset".
Scene make_garden(uint32_t seed);

/// What nearly all things of these scenes are made of: no metal, no gloss.
inline Material matte(const char* name, const glm::vec3& color, bool double_sided) {
  Material m;
  m.name = name;
  m.base_color = glm::vec4{color, 1.0f};
  m.metallic = 0.0f;
  m.roughness = 0.9f;
  m.double_sided = double_sided;
  return m;
}

/// One entry of the table of procedural scenes.
struct Procedural {
  const char* name;
  const char* help;    ///< one line
  size_t triangles;    ///< by default, within 2 %
  bool any_triangles;  ///< whether another number can be asked for
  Scene (*make_sized)(const char* name, uint32_t seed, size_t triangles, size_t default_triangles);

  /// The scene with about `wanted` triangles, 0: as many as by default.
  Scene make(uint32_t seed, size_t wanted = 0) const;
};

/// Every procedural scene there is.
std::span<const Procedural> procedurals();

}  // namespace izb

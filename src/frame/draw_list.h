// SPDX-License-Identifier: MIT
// The order in which a scene is drawn, and with it the numbering of the frame's triangles. Plain data.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace izb {

/// As glMultiDrawElementsIndirect reads it.
struct DrawCommand {
  uint32_t index_count = 0, instance_count = 0, first_index = 0, base_vertex = 0, base_instance = 0;
};

/// Commands that share a base-colour texture.
struct DrawGroup {
  int texture = -1;  ///< index into Scene::textures or -1
  uint32_t first_command = 0, command_count = 0;
};

/// Ranges of deformed vertices begin at multiples of it, so that each can be bound alone.
inline constexpr uint32_t deformed_vertex_alignment = 64;

struct DrawList {
  std::vector<uint32_t> instances;       ///< indices into Scene::instances, in drawing order
  std::vector<uint32_t> first_triangle;  ///< of each entry of `instances`, in the frame's numbering
  std::vector<uint32_t> first_index;     ///< of each mesh in the joined index buffer
  std::vector<uint32_t>
      base_vertex;  ///< of each entry of `instances`: what its mesh's vertex 0 is in the joined buffers
  std::vector<uint32_t> first_vertex;  ///< of each mesh at rest in those, no_vertex: not there, since it only deforms
  std::vector<DrawCommand> commands;   ///< one a mesh that is placed at all, one an instance that deforms
  std::vector<DrawGroup> groups;
  uint32_t vertex_count = 0, index_count = 0, triangle_count = 0;

  static constexpr uint32_t no_vertex = 0xFFFFFFFFu;
};

/// An instance that deforms has vertices of its own. Throws izb::Error if the scene has more triangles or vertices than
/// 32 bits can number.
DrawList make_draw_list(const Scene& scene);

}  // namespace izb

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

struct DrawList {
  std::vector<uint32_t> instances;       ///< indices into Scene::instances, in drawing order
  std::vector<uint32_t> first_triangle;  ///< of each entry of `instances`, in the frame's numbering
  std::vector<uint32_t> first_index;     ///< of each mesh in the joined index buffer
  std::vector<uint32_t> first_vertex;    ///< of each mesh in the joined vertex buffers
  std::vector<DrawCommand> commands;     ///< one a mesh that is placed at all
  std::vector<DrawGroup> groups;
  uint32_t vertex_count = 0, index_count = 0, triangle_count = 0;
};

/// Throws izb::Error if the scene has more triangles or vertices than 32 bits can number.
DrawList make_draw_list(const Scene& scene);

}  // namespace izb

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

/// What of a scene a draw is about: triangles of masked materials take programs of their own.
enum class Drawn { all, opaque, masked };

/// Commands one after another that share a base-colour texture.
struct DrawGroup {
  int texture = -1;  ///< index into Scene::textures or -1
  bool masked = false;
  uint32_t first_command = 0, command_count = 0;
  uint64_t triangle_count = 0;
};

/// An instance, or of a large one some of its triangles: what the G-buffer's id names, by its place in the list.
struct DrawPart {
  uint32_t instance = 0;       ///< entry of Scene::instances
  uint32_t mesh_triangle = 0;  ///< its first triangle, as the mesh counts them
  uint32_t triangle_count = 0;
  uint32_t first_triangle = 0;  ///< in the frame's numbering
  uint32_t first_index = 0;     ///< in the joined index buffer
  uint32_t base_vertex = 0;     ///< what its mesh's vertex 0 is in the joined vertex buffers
};

/// Parts, commands and groups have at most so many triangles (but for a group of one command), so that a software
/// renderer, which stores what it has not yet rasterised, can be made to finish in between.
inline constexpr uint32_t largest_part_triangles = 1u << 16;

/// Ranges of deformed vertices begin at multiples of it, so that each can be bound alone.
inline constexpr uint32_t deformed_vertex_alignment = 64;

struct DrawList {
  std::vector<DrawPart> parts;           ///< in drawing order
  std::vector<uint32_t> first_triangle;  ///< of each part
  std::vector<uint32_t> first_index;     ///< of each mesh in the joined index buffer
  std::vector<uint32_t> first_vertex;    ///< of each mesh at rest in those, no_vertex: not there, since it only deforms
  std::vector<DrawCommand>
      commands;  ///< each draws a part, or the same part of several instances at rest; masked ones last
  std::vector<DrawGroup> groups;
  uint32_t opaque_commands = 0;                      ///< the commands before the masked ones
  uint32_t part_triangles = largest_part_triangles;  ///< at most so many in a part
  uint32_t vertex_count = 0, index_count = 0, triangle_count = 0;

  static constexpr uint32_t no_vertex = 0xFFFFFFFFu;
};

/// Triangles before the first masked one, in the frame's numbering.
uint32_t opaque_triangles(const DrawList& list);

inline bool has_masked(const DrawList& list) {
  return list.opaque_commands < list.commands.size();
}

/// An instance that deforms has vertices of its own. Throws izb::Error if the scene has more triangles or vertices than
/// 32 bits can number. `part_triangles`, for tests, takes the place of largest_part_triangles.
DrawList make_draw_list(const Scene& scene, uint32_t part_triangles = largest_part_triangles);

}  // namespace izb

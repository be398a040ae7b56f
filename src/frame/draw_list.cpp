// SPDX-License-Identifier: MIT
#include "frame/draw_list.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/error.h"

namespace izb {

namespace {

constexpr uint64_t limit = std::numeric_limits<uint32_t>::max() / 4;

/// Meshes at rest as far as an instance shows them so, one after another.
void place_meshes(const Scene& scene, DrawList& list) {
  std::vector<bool> rigid(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances)
    if (!instance.deforms()) rigid[instance.mesh] = true;
  uint64_t vertices = 0, indices = 0;
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    list.first_vertex.push_back(rigid[m] ? static_cast<uint32_t>(vertices) : DrawList::no_vertex);
    list.first_index.push_back(static_cast<uint32_t>(indices));
    if (rigid[m]) vertices += scene.meshes[m].positions.size();
    indices += scene.meshes[m].indices.size();
    if (vertices > limit || indices > limit) fail("scene '{}' has too many vertices for 32-bit indices", scene.name);
  }
  if (scene.triangle_count() > limit) fail("scene '{}' has too many triangles to number in 32 bits", scene.name);
  list.vertex_count = static_cast<uint32_t>(vertices);
  list.index_count = static_cast<uint32_t>(indices);
}

/// Where the instance's vertices begin: its mesh's, or, behind all others, its own.
uint32_t place_vertices(const Scene& scene, const Instance& instance, DrawList& list) {
  if (!instance.deforms()) return list.first_vertex[instance.mesh];
  const uint64_t alignment = deformed_vertex_alignment;
  const uint64_t first = (list.vertex_count + alignment - 1) / alignment * alignment;
  const uint64_t end = first + scene.meshes[instance.mesh].positions.size();
  if (end > limit) fail("scene '{}' has too many vertices for 32-bit indices", scene.name);
  list.vertex_count = static_cast<uint32_t>(end);
  return static_cast<uint32_t>(first);
}

}  // namespace

DrawList make_draw_list(const Scene& scene) {
  DrawList list;
  place_meshes(scene, list);

  const auto key = [&](uint32_t i) {
    const uint32_t mesh = scene.instances[i].mesh;
    return std::tuple(scene.materials[scene.meshes[mesh].material].base_color_texture, mesh, i);
  };
  list.instances.resize(scene.instances.size());
  std::iota(list.instances.begin(), list.instances.end(), 0u);
  std::sort(list.instances.begin(), list.instances.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });

  uint32_t previous_mesh = std::numeric_limits<uint32_t>::max();
  for (uint32_t i = 0; i < list.instances.size(); ++i) {
    const Instance& instance = scene.instances[list.instances[i]];
    const uint32_t mesh_index = instance.mesh;
    const Mesh& mesh = scene.meshes[mesh_index];
    const int texture = scene.materials[mesh.material].base_color_texture;
    list.first_triangle.push_back(list.triangle_count);
    list.triangle_count += static_cast<uint32_t>(mesh.triangle_count());
    list.base_vertex.push_back(place_vertices(scene, instance, list));
    if (mesh_index == previous_mesh && list.base_vertex[i] == list.base_vertex[i - 1]) {
      ++list.commands.back().instance_count;
      continue;
    }
    previous_mesh = mesh_index;
    if (list.groups.empty() || list.groups.back().texture != texture)
      list.groups.push_back({texture, static_cast<uint32_t>(list.commands.size()), 0});
    ++list.groups.back().command_count;
    list.commands.push_back(
        {static_cast<uint32_t>(mesh.indices.size()), 1, list.first_index[mesh_index], list.base_vertex[i], i});
  }
  return list;
}

}  // namespace izb

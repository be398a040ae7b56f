// SPDX-License-Identifier: MIT
#include "frame/draw_list.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/error.h"

namespace izb {

DrawList make_draw_list(const Scene& scene) {
  constexpr uint64_t limit = std::numeric_limits<uint32_t>::max() / 4;
  DrawList list;
  uint64_t vertices = 0, indices = 0;
  for (const Mesh& mesh : scene.meshes) {
    list.first_vertex.push_back(static_cast<uint32_t>(vertices));
    list.first_index.push_back(static_cast<uint32_t>(indices));
    vertices += mesh.positions.size();
    indices += mesh.indices.size();
    if (vertices > limit || indices > limit) fail("scene '{}' has too many vertices for 32-bit indices", scene.name);
  }
  if (scene.triangle_count() > limit) fail("scene '{}' has too many triangles to number in 32 bits", scene.name);
  list.vertex_count = static_cast<uint32_t>(vertices);
  list.index_count = static_cast<uint32_t>(indices);

  const auto key = [&](uint32_t i) {
    const uint32_t mesh = scene.instances[i].mesh;
    return std::tuple(scene.materials[scene.meshes[mesh].material].base_color_texture, mesh, i);
  };
  list.instances.resize(scene.instances.size());
  std::iota(list.instances.begin(), list.instances.end(), 0u);
  std::sort(list.instances.begin(), list.instances.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });

  uint32_t previous_mesh = std::numeric_limits<uint32_t>::max();
  for (uint32_t i = 0; i < list.instances.size(); ++i) {
    const uint32_t mesh_index = scene.instances[list.instances[i]].mesh;
    const Mesh& mesh = scene.meshes[mesh_index];
    const int texture = scene.materials[mesh.material].base_color_texture;
    list.first_triangle.push_back(list.triangle_count);
    list.triangle_count += static_cast<uint32_t>(mesh.triangle_count());
    if (mesh_index == previous_mesh) {
      ++list.commands.back().instance_count;
      continue;
    }
    previous_mesh = mesh_index;
    if (list.groups.empty() || list.groups.back().texture != texture)
      list.groups.push_back({texture, static_cast<uint32_t>(list.commands.size()), 0});
    ++list.groups.back().command_count;
    list.commands.push_back({static_cast<uint32_t>(mesh.indices.size()), 1, list.first_index[mesh_index], 0, i});
  }
  return list;
}

}  // namespace izb

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

/// Instances in drawing order: masked ones last, of both those of one texture together, then those of one mesh.
std::vector<uint32_t> ordered_instances(const Scene& scene) {
  const auto key = [&](uint32_t i) {
    const uint32_t mesh = scene.instances[i].mesh;
    const Material& material = scene.materials[scene.meshes[mesh].material];
    return std::tuple(material.masked(), material.base_color_texture, mesh, i);
  };
  std::vector<uint32_t> order(scene.instances.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  return order;
}

/// Appends parts, commands and groups to a list whose meshes are placed.
class Builder {
 public:
  Builder(const Scene& scene, uint32_t part_triangles, DrawList& list)
      : scene_(scene), part_triangles_(part_triangles), list_(list) {}

  /// The instances in [first, end) show one mesh.
  void add(const uint32_t* first, const uint32_t* end) {
    std::vector<uint32_t> base_vertices;
    for (const uint32_t* i = first; i != end; ++i)
      base_vertices.push_back(place_vertices(scene_, scene_.instances[*i], list_));
    const Mesh& mesh = scene_.meshes[scene_.instances[*first].mesh];
    const auto triangles = static_cast<uint32_t>(mesh.triangle_count());
    for (uint32_t from = 0; from < triangles; from += part_triangles_) {
      const uint32_t count = std::min(part_triangles_, triangles - from);
      for (const uint32_t* i = first; i != end; ++i)
        add_part(*i, from, count, base_vertices[static_cast<size_t>(i - first)]);
    }
  }

 private:
  void add_part(uint32_t instance, uint32_t mesh_triangle, uint32_t triangle_count, uint32_t base_vertex) {
    const uint32_t mesh = scene_.instances[instance].mesh;
    const uint32_t first_index = list_.first_index[mesh] + 3 * mesh_triangle;
    list_.parts.push_back({instance, mesh_triangle, triangle_count, list_.triangle_count, first_index, base_vertex});
    list_.first_triangle.push_back(list_.triangle_count);
    list_.triangle_count += triangle_count;
    if (!list_.commands.empty()) {
      DrawCommand& last = list_.commands.back();
      const uint64_t together = (uint64_t(last.instance_count) + 1) * triangle_count;
      if (last.first_index == first_index && last.base_vertex == base_vertex && together <= part_triangles_) {
        ++last.instance_count;
        list_.groups.back().triangle_count += triangle_count;
        return;
      }
    }
    add_command(mesh, {3 * triangle_count, 1, first_index, base_vertex, static_cast<uint32_t>(list_.parts.size() - 1)});
  }

  void add_command(uint32_t mesh, const DrawCommand& command) {
    const Material& material = scene_.materials[scene_.meshes[mesh].material];
    const int texture = material.base_color_texture;
    const bool full = !list_.groups.empty() && list_.groups.back().triangle_count >= part_triangles_;
    if (list_.groups.empty() || list_.groups.back().texture != texture ||
        list_.groups.back().masked != material.masked() || full)
      list_.groups.push_back({texture, material.masked(), static_cast<uint32_t>(list_.commands.size()), 0, 0});
    ++list_.groups.back().command_count;
    list_.groups.back().triangle_count += command.index_count / 3;
    list_.opaque_commands += !material.masked();
    list_.commands.push_back(command);
  }

  const Scene& scene_;
  const uint32_t part_triangles_;
  DrawList& list_;
};

}  // namespace

uint32_t opaque_triangles(const DrawList& list) {
  uint64_t sum = 0;
  for (const DrawGroup& group : list.groups)
    if (!group.masked) sum += group.triangle_count;
  return static_cast<uint32_t>(sum);
}

DrawList make_draw_list(const Scene& scene, uint32_t part_triangles) {
  DrawList list;
  list.part_triangles = part_triangles;
  place_meshes(scene, list);
  const std::vector<uint32_t> order = ordered_instances(scene);
  Builder builder(scene, part_triangles, list);
  const uint32_t* const end = order.data() + order.size();
  for (const uint32_t* first = order.data(); first != end;) {
    const uint32_t mesh = scene.instances[*first].mesh;
    const uint32_t* const last = std::find_if(first, end, [&](uint32_t i) { return scene.instances[i].mesh != mesh; });
    builder.add(first, last);
    first = last;
  }
  return list;
}

}  // namespace izb

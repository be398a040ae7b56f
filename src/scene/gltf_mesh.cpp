// SPDX-License-Identifier: MIT
#include "scene/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_deform.h"
#include "scene/gltf_material.h"

namespace izb {
namespace {

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto it = primitive.attributes.find(name);
  return it == primitive.attributes.end() ? -1 : it->second;
}

void check_count(const tinygltf::Model& model, int accessor, size_t count, const std::string& name) {
  if (accessor_count(model, accessor) != count)
    fail("{} has {} elements, but POSITION has {}", name, accessor_count(model, accessor), count);
}

/// Unrolls a strip or fan (glTF 2.0, section 3.7.2.1) and drops an incomplete last triangle.
std::vector<uint32_t> to_triangle_list(std::vector<uint32_t> order, int mode, MeshTally& tally) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    const size_t extra = order.size() % 3;
    tally.trailing_indices += extra;
    order.resize(order.size() - extra);
    return order;
  }
  if (order.size() < 3) {
    tally.trailing_indices += order.size();
    return {};
  }
  std::vector<uint32_t> list;
  list.reserve(3 * (order.size() - 2));
  for (size_t i = 0; i + 2 < order.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      list.insert(list.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    else
      list.insert(list.end(), {order[i + 1], order[i + 2], order[0]});
  }
  return list;
}

std::vector<uint32_t> load_indices(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                   size_t vertex_count, MeshTally& tally) {
  std::vector<uint32_t> order;
  if (primitive.indices < 0) {
    order.resize(vertex_count);
    std::iota(order.begin(), order.end(), 0u);
  } else {
    order = read_indices(model, primitive.indices);
    const auto largest = std::max_element(order.begin(), order.end());
    if (largest != order.end() && *largest >= vertex_count)
      fail("index {} is out of range ({} vertices)", *largest, vertex_count);
  }
  return to_triangle_list(std::move(order), primitive.mode, tally);
}

/// Makes every normal unit length. Where that is impossible, the area-weighted normal of the vertex's
/// triangles takes its place.
void normalize_normals(Mesh& mesh, MeshTally& tally) {
  std::vector<bool> bad;
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const float length = glm::length(mesh.normals[i]);
    if (length > 1e-20f && std::isfinite(length)) {
      mesh.normals[i] /= length;
      continue;
    }
    if (bad.empty()) bad.resize(mesh.normals.size());
    bad[i] = true;
    mesh.normals[i] = glm::vec3(0.0f);
    ++tally.bad_normals;
  }
  if (bad.empty()) return;
  std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0.0));
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const uint32_t* v = &mesh.indices[t];
    const glm::dvec3 a(mesh.positions[v[0]]), b(mesh.positions[v[1]]), c(mesh.positions[v[2]]);
    for (int k = 0; k < 3; ++k)
      if (bad[v[k]]) sums[v[k]] += glm::cross(b - a, c - a);
  }
  for (size_t i = 0; i < bad.size(); ++i) {
    if (!bad[i]) continue;
    const double length = glm::length(sums[i]);
    mesh.normals[i] = length > 0.0 && std::isfinite(length) ? glm::vec3(sums[i] / length) : glm::vec3(0, 1, 0);
  }
}

template <typename T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<uint32_t>& kept, size_t per_vertex = 1) {
  std::vector<T> out;
  if (all.empty()) return out;
  out.reserve(kept.size() * per_vertex);
  for (const uint32_t i : kept)
    for (size_t k = 0; k < per_vertex; ++k) out.push_back(all[i * per_vertex + k]);
  return out;
}

/// Files often share one large vertex array between many primitives: each keeps only the vertices that it
/// uses.
void drop_unused_vertices(Mesh& mesh) {
  if (mesh.positions.size() <= mesh.indices.size()) return;
  constexpr uint32_t unused = 0xffffffffu;
  std::vector<uint32_t> new_index(mesh.positions.size(), unused), kept;
  for (uint32_t& index : mesh.indices) {
    uint32_t& target = new_index[index];
    if (target == unused) {
      target = static_cast<uint32_t>(kept.size());
      kept.push_back(index);
    }
    index = target;
  }
  mesh.positions = chosen(mesh.positions, kept);
  mesh.normals = chosen(mesh.normals, kept);
  mesh.uvs = chosen(mesh.uvs, kept);
  mesh.joints = chosen(mesh.joints, kept, mesh.influences);
  mesh.weights = chosen(mesh.weights, kept, mesh.influences);
  for (MorphTarget& target : mesh.targets) {
    target.positions = chosen(target.positions, kept);
    target.normals = chosen(target.normals, kept);
  }
}

void check_positions(const Mesh& mesh, const ElementRange& range) {
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    if (!finite(mesh.positions[i])) fail("the position of vertex {} is not finite", range.first + i);
}

/// The vertices between the lowest and the highest index: of a large array that many primitives share, only a part is
/// read. The indices count from its first one afterwards.
ElementRange take_range(std::vector<uint32_t>& indices) {
  if (indices.empty()) return {0, 0};
  const auto [low, high] = std::minmax_element(indices.begin(), indices.end());
  const ElementRange range{*low, size_t(*high) - *low + 1};
  if (range.first > 0)
    for (uint32_t& index : indices) index -= static_cast<uint32_t>(range.first);
  return range;
}

/// All counts agree, so that one range fits all.
void check_counts(const tinygltf::Model& model, const tinygltf::Primitive& primitive, size_t vertex_count) {
  for (const auto& [name, accessor] : primitive.attributes) check_count(model, accessor, vertex_count, name);
  for (size_t t = 0; t < primitive.targets.size(); ++t)
    for (const auto& [name, accessor] : primitive.targets[t])
      check_count(model, accessor, vertex_count, fmt::format("{} of morph target {}", name, t));
}

std::optional<Mesh> load_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                   MeshTally& tally) {
  const int positions = attribute(primitive, "POSITION");
  if (positions < 0) {
    ++tally.without_positions;
    return {};
  }
  const size_t vertex_count = accessor_count(model, positions);
  if (vertex_count > 0xffffffffu) fail("it has more than 2^32 vertices");
  check_counts(model, primitive, vertex_count);

  Mesh mesh;
  mesh.indices = load_indices(model, primitive, vertex_count, tally);
  const ElementRange range = take_range(mesh.indices);
  mesh.positions = read_vec3(model, positions, range);
  check_positions(mesh, range);
  if (const int normals = attribute(primitive, "NORMAL"); normals >= 0) mesh.normals = read_vec3(model, normals, range);
  if (const int set = base_color_uv_set(model, primitive.material); set >= 0)
    if (const int uvs = attribute(primitive, fmt::format("TEXCOORD_{}", set)); uvs >= 0) {
      mesh.uvs = read_vec2(model, uvs, range);
      for (glm::vec2& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0.0f);
    }
  load_morph_targets(model, primitive, range, mesh);
  load_influences(model, primitive, range, mesh);
  if (mesh.indices.empty()) return {};
  tally.colored_primitives += attribute(primitive, "COLOR_0") >= 0;
  normalize_normals(mesh, tally);
  drop_unused_vertices(mesh);
  return mesh;
}

}  // namespace

std::optional<Mesh> load_primitive(const tinygltf::Model& model, int mesh_index, int primitive_index,
                                   MeshTally& tally) {
  const tinygltf::Mesh& gltf_mesh = model.meshes[static_cast<size_t>(mesh_index)];
  const tinygltf::Primitive& primitive = gltf_mesh.primitives[static_cast<size_t>(primitive_index)];
  const std::string name = gltf_mesh.name.empty() ? "" : fmt::format(" ('{}')", gltf_mesh.name);
  switch (primitive.mode) {
    case TINYGLTF_MODE_POINTS:
      ++tally.point_primitives;
      return {};
    case TINYGLTF_MODE_LINE:
    case TINYGLTF_MODE_LINE_LOOP:
    case TINYGLTF_MODE_LINE_STRIP:
      ++tally.line_primitives;
      return {};
    case TINYGLTF_MODE_TRIANGLES:
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
      break;
    default:
      fail("mesh {}{}, primitive {}: there is no primitive mode {}", mesh_index, name, primitive_index, primitive.mode);
  }
  try {
    std::optional<Mesh> mesh = load_triangles(model, primitive, tally);
    if (mesh) {
      mesh->name = gltf_mesh.name;
      mesh->material =
          static_cast<uint32_t>(primitive.material < 0 ? static_cast<int>(model.materials.size()) : primitive.material);
    }
    return mesh;
  } catch (const Error& e) {
    fail("mesh {}{}, primitive {}: {}", mesh_index, name, primitive_index, e.what());
  }
}

void MeshTally::describe(std::vector<std::string>& ignored, bool stays) const {
  const auto say = [&](const char* what, size_t count, const char* consequence) {
    if (count > 0) ignored.push_back(fmt::format("{}: {}, {}", what, count, consequence));
  };
  say("primitives made of points", point_primitives, "not shown");
  say("primitives made of lines", line_primitives, "not shown");
  say("primitives without positions", without_positions, "not shown");
  say("vertices beyond the last whole triangle of their primitive", trailing_indices, "not used");
  say("normals without a direction", bad_normals, "replaced by the normal of their triangles");
  say("primitives with vertex colours", colored_primitives, "the colours are not shown");
  if (!stays) return;
  say("skinned primitives", skinned_primitives, "standing in bind pose (their joints at rest)");
  say("primitives with morph targets", morphed_primitives, "standing still with their default weights");
}

}  // namespace izb

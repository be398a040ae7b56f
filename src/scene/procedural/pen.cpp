// SPDX-License-Identifier: MIT
#include "scene/procedural/pen.h"

#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/builder.h"
#include "scene/shapes.h"

namespace izb::procedural {

using glm::dvec2;
using glm::dvec3;

namespace {

constexpr size_t most_triangles_of_a_mesh = 1 << 20;

size_t tube_triangles(size_t points, int sides) {
  return size_t(2 * sides) * (points - 1) + size_t(2 * (sides - 2));
}

/// Sums of the faces' normals, each as long as twice the face's area.
void add_face_normals(std::vector<dvec3>& normals, const std::vector<dvec3>& points,
                      std::span<const uint32_t> corners) {
  for (size_t i = 0; i < corners.size(); i += 3) {
    const dvec3& a = points[corners[i]];
    const dvec3 normal = glm::cross(points[corners[i + 1]] - a, points[corners[i + 2]] - a);
    for (size_t k = 0; k < 3; ++k) normals[corners[i + k]] += normal;
  }
}

}  // namespace

bool Pen::counts(size_t triangles) const {
  batch_->triangles += triangles;
  return builder_->counting_;
}

Mesh& Pen::mesh() const {
  std::vector<Mesh>& meshes = builder_->scene_.meshes;
  const bool full =
      batch_->mesh >= 0 && !batch_->part && meshes[size_t(batch_->mesh)].triangle_count() >= most_triangles_of_a_mesh;
  if (batch_->mesh < 0 || full) {
    batch_->mesh = int(meshes.size());
    Mesh fresh;
    fresh.name = batch_->name;
    fresh.material = batch_->material;
    meshes.push_back(std::move(fresh));
    if (!batch_->part) builder_->scene_.instances.push_back({uint32_t(batch_->mesh), glm::dmat4{1.0}});
  }
  return meshes[size_t(batch_->mesh)];
}

template <typename Add>
void Pen::draw(size_t triangles, const Add& add) const {
  if (counts(triangles)) return;
  Mesh& out = mesh();
  const size_t first_vertex = out.positions.size(), first_index = out.indices.size();
  add(out);
  if (place_ == glm::dmat4{1.0}) return;
  const glm::dmat3 turn{place_};
  const dvec3 shift{place_[3]};
  for (size_t i = first_vertex; i < out.positions.size(); ++i) {
    out.positions[i] = turn * dvec3{out.positions[i]} + shift;
    out.normals[i] = glm::normalize(turn * dvec3{out.normals[i]});
  }
  if (glm::determinant(turn) < 0.0)  // mirrored
    for (size_t i = first_index; i < out.indices.size(); i += 3) std::swap(out.indices[i + 1], out.indices[i + 2]);
}

void Pen::triangle(const dvec3& a, const dvec3& b, const dvec3& c) const {
  draw(1, [&](Mesh& out) {
    const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const dvec3& p : {a, b, c}) {
      out.indices.push_back(uint32_t(out.positions.size()));
      out.positions.emplace_back(p);
      out.normals.emplace_back(normal);
    }
  });
}

void Pen::grid_quad(const Corners& c, int segments_u, int segments_v) const {
  draw(size_t(2 * segments_u * segments_v), [&](Mesh& out) {
    const dvec3 normal = glm::normalize(glm::cross(c[2] - c[0], c[3] - c[1]));
    const uint32_t first = uint32_t(out.positions.size()), row = uint32_t(segments_u) + 1;
    for (int j = 0; j <= segments_v; ++j)
      for (int i = 0; i <= segments_u; ++i) {
        const double u = double(i) / segments_u, v = double(j) / segments_v;
        out.positions.emplace_back(glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[3], c[2], u), v));
        out.normals.emplace_back(normal);
      }
    for (uint32_t j = 0; j < uint32_t(segments_v); ++j)
      for (uint32_t i = 0; i < uint32_t(segments_u); ++i) {
        const uint32_t a = first + j * row + i;
        out.indices.insert(out.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
      }
  });
}

void Pen::quad(const Corners& c) const {
  const int u = builder_->flat_pieces(glm::length(c[1] - c[0]));
  grid_quad(c, u, builder_->flat_pieces(glm::length(c[3] - c[0])));
}

void Pen::box(const dvec3& low, const dvec3& high) const {
  const auto level = [&](double y) {
    return Corners{dvec3{low.x, y, high.z}, dvec3{high.x, y, high.z}, dvec3{high.x, y, low.z}, dvec3{low.x, y, low.z}};
  };
  hexahedron(level(low.y), level(high.y));
}

void Pen::hexahedron(const Corners& bottom, const Corners& top) const {
  const int x = builder_->flat_pieces(glm::length(bottom[1] - bottom[0]));
  const int y = builder_->flat_pieces(glm::length(top[0] - bottom[0]));
  const int z = builder_->flat_pieces(glm::length(bottom[2] - bottom[1]));
  for (size_t i = 0; i < 4; ++i) {
    const size_t j = (i + 1) % 4;
    grid_quad({bottom[i], bottom[j], top[j], top[i]}, i % 2 == 0 ? x : z, y);
  }
  grid_quad(top, x, z);
  grid_quad({bottom[3], bottom[2], bottom[1], bottom[0]}, x, z);
}

void Pen::beam(const dvec3& from, const dvec3& to, double width, double thickness, const dvec3& up) const {
  const dvec3 heading = glm::normalize(to - from);
  const dvec3 side = 0.5 * width * glm::normalize(glm::cross(heading, up));
  const dvec3 above = 0.5 * thickness * glm::normalize(glm::cross(side, heading));
  const auto section = [&](const dvec3& p) {
    return Corners{p - side - above, p + side - above, p + side + above, p - side + above};
  };
  hexahedron(section(to), section(from));
}

void Pen::prism(std::span<const dvec2> polygon, double low, double high) const {
  const size_t n = polygon.size();
  const auto point = [&](size_t i, double y) { return dvec3{polygon[i % n].x, y, polygon[i % n].y}; };
  for (size_t i = 0; i < n; ++i) {
    quad({point(i, low), point(i + 1, low), point(i + 1, high), point(i, high)});
    if (i == 0 || i + 1 == n) continue;
    triangle(point(0, high), point(i, high), point(i + 1, high));
    triangle(point(0, low), point(i + 1, low), point(i, low));
  }
}

void Pen::rod(const dvec3& from, const dvec3& to, double radius, int sides) const {
  draw(tube_triangles(2, sides), [&](Mesh& out) { shapes::add_rod(out, from, to, radius, sides); });
}

void Pen::tube(std::span<const dvec3> path, double radius, int sides) const {
  draw(tube_triangles(path.size(), sides), [&](Mesh& out) { shapes::add_tube(out, path, radius, sides); });
}

void Pen::tube(std::span<const dvec3> path, std::span<const double> radii, int sides) const {
  draw(tube_triangles(path.size(), sides), [&](Mesh& out) { shapes::add_tube(out, path, radii, sides); });
}

void Pen::hair(std::span<const dvec3> path, double radius, int sides) const {
  const size_t rings = path.size() - 1;
  draw(size_t(sides) * (2 * (rings - 1) + 1), [&](Mesh& out) {
    const uint32_t first = uint32_t(out.positions.size()), n = uint32_t(sides);
    dvec3 side = across(path[1] - path[0]);
    for (size_t k = 0; k <= rings; ++k) {
      const dvec3 tangent = glm::normalize(path[std::min(k + 1, rings)] - path[k > 0 ? k - 1 : 0]);
      if (k == rings) {
        out.positions.emplace_back(path[k]);
        out.normals.emplace_back(tangent);
        break;
      }
      side = glm::normalize(side - glm::dot(side, tangent) * tangent);
      const dvec3 other = glm::cross(tangent, side);
      const double t = double(k) / double(rings), here = radius * (1.0 - t * t * 0.8);
      for (int i = 0; i < sides; ++i) {
        const dvec2 on = on_circle(2.0 * std::numbers::pi * i / sides);
        const dvec3 normal = on.x * side + on.y * other;
        out.positions.emplace_back(path[k] + here * normal);
        out.normals.emplace_back(glm::normalize(normal));
      }
    }
    for (uint32_t k = 0; k < uint32_t(rings); ++k)
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t lower = first + k * n, a = lower + i, b = lower + (i + 1) % n;
        if (k + 1 == rings)
          out.indices.insert(out.indices.end(), {a, b, lower + n});
        else
          out.indices.insert(out.indices.end(), {a, b, b + n, a, b + n, a + n});
      }
  });
}

void Pen::ring(const dvec3& center, const dvec3& axis, double ring_radius, double tube_radius, int segments,
               int sides) const {
  draw(size_t(2 * segments * sides),
       [&](Mesh& out) { shapes::add_ring(out, center, axis, ring_radius, tube_radius, segments, sides); });
}

void Pen::lathe(std::span<const dvec2> profile, int sides) const {
  size_t triangles = 0;
  for (size_t i = 1; i < profile.size(); ++i)
    if (profile[i] != profile[i - 1])
      triangles += size_t(sides) * ((profile[i - 1].x != 0.0 ? 1 : 0) + (profile[i].x != 0.0 ? 1 : 0));
  draw(triangles, [&](Mesh& out) { shapes::add_lathe(out, profile, sides); });
}

void Pen::ball(const dvec3& center, double radius, int sides) const {
  surface(sides, std::max(2, sides / 2), {.wrap_u = true, .pole_begin = true, .pole_end = true},
          [&](double u, double v) {
            const dvec2 around = on_circle(2.0 * std::numbers::pi * u), up = on_circle(std::numbers::pi * v);
            return center + radius * dvec3{up.y * around.x, -up.x, -up.y * around.y};
          });
}

void Pen::surface(int segments_u, int segments_v, const Closing& closing,
                  const std::function<dvec3(double, double)>& position) const {
  const size_t poles = (closing.pole_begin ? 1u : 0u) + (closing.pole_end ? 1u : 0u);
  draw(size_t(segments_u) * (2 * size_t(segments_v) - poles), [&](Mesh& out) {
    const int columns = segments_u + (closing.wrap_u ? 0 : 1), rows = segments_v + (closing.wrap_v ? 0 : 1);
    const auto is_pole = [&](int j) { return (closing.pole_begin && j == 0) || (closing.pole_end && j == segments_v); };
    std::vector<dvec3> points;
    std::vector<uint32_t> row_start;
    for (int j = 0; j < rows; ++j) {
      row_start.push_back(uint32_t(points.size()));
      for (int i = 0; i < (is_pole(j) ? 1 : columns); ++i)
        points.push_back(position(double(i) / segments_u, double(j) / segments_v));
    }
    const auto vertex = [&](int i, int j) {
      const int row = j % rows;
      return row_start[size_t(row)] + (is_pole(j) ? 0u : uint32_t(i % columns));
    };
    std::vector<uint32_t> corners;
    for (int j = 0; j < segments_v; ++j)
      for (int i = 0; i < segments_u; ++i) {
        const uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
        if (!is_pole(j)) corners.insert(corners.end(), {a, b, c});
        if (!is_pole(j + 1)) corners.insert(corners.end(), {a, c, d});
      }
    std::vector<dvec3> normals(points.size(), dvec3{0.0});
    add_face_normals(normals, points, corners);
    const uint32_t first = uint32_t(out.positions.size());
    for (size_t i = 0; i < points.size(); ++i) {
      out.positions.emplace_back(points[i]);
      out.normals.emplace_back(glm::normalize(normals[i]));
    }
    for (const uint32_t corner : corners) out.indices.push_back(first + corner);
  });
}

}  // namespace izb::procedural

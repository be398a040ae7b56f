// SPDX-License-Identifier: MIT
#include "scene/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/portable_math.h"

namespace izb::shapes {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double two_pi = 2.0 * std::numbers::pi;

uint32_t add_vertex(Mesh& mesh, const dvec3& position, const dvec3& normal) {
  mesh.positions.emplace_back(position);
  mesh.normals.emplace_back(glm::normalize(normal));
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void add_triangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Corners counter-clockwise.
void add_flat_quad(Mesh& mesh, const std::array<dvec3, 4>& p) {
  const dvec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
  const uint32_t first = add_vertex(mesh, p[0], normal);
  for (int i = 1; i < 4; ++i) add_vertex(mesh, p[i], normal);
  add_triangle(mesh, first, first + 1, first + 2);
  add_triangle(mesh, first, first + 2, first + 3);
}

/// The hexahedron over two quads, each counter-clockwise seen from above, `bottom` below `top`.
void add_sides(Mesh& mesh, const std::array<dvec3, 4>& bottom, const std::array<dvec3, 4>& top) {
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add_flat_quad(mesh, {bottom[i], bottom[j], top[j], top[i]});
  }
}

void add_hexahedron(Mesh& mesh, const std::array<dvec3, 4>& bottom, const std::array<dvec3, 4>& top) {
  add_sides(mesh, bottom, top);
  add_flat_quad(mesh, top);
  add_flat_quad(mesh, {bottom[3], bottom[2], bottom[1], bottom[0]});
}

std::array<dvec3, 4> level_rectangle(const dvec3& low, const dvec3& high, double y, double inset) {
  return {dvec3{low.x + inset, y, high.z - inset}, dvec3{high.x - inset, y, high.z - inset},
          dvec3{high.x - inset, y, low.z + inset}, dvec3{low.x + inset, y, low.z + inset}};
}

dvec3 any_perpendicular(const dvec3& direction) {
  const dvec3 axis = std::abs(direction.y) < 0.9 ? dvec3{0, 1, 0} : dvec3{1, 0, 0};
  return glm::normalize(glm::cross(direction, axis));
}

/// Joins two rings of `sides` vertices; `upper` follows `lower` along the tube.
void join_rings(Mesh& mesh, uint32_t lower, uint32_t upper, int sides) {
  for (int i = 0; i < sides; ++i) {
    const uint32_t a = static_cast<uint32_t>(i), b = static_cast<uint32_t>((i + 1) % sides);
    add_triangle(mesh, lower + a, lower + b, upper + b);
    add_triangle(mesh, lower + a, upper + b, upper + a);
  }
}

/// A flat cap over a copy of the ring at `ring`, facing along `normal`.
void add_cap(Mesh& mesh, uint32_t ring, int sides, const dvec3& normal, bool reversed) {
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  for (int i = 0; i < sides; ++i) add_vertex(mesh, dvec3(mesh.positions[ring + static_cast<uint32_t>(i)]), normal);
  for (uint32_t i = 1; i + 1 < static_cast<uint32_t>(sides); ++i) {
    if (reversed) {
      add_triangle(mesh, first, first + i + 1, first + i);
    } else {
      add_triangle(mesh, first, first + i, first + i + 1);
    }
  }
}

uint32_t add_ring_vertices(Mesh& mesh, const dvec3& center, const dvec3& side, const dvec3& tangent, double radius,
                           int sides) {
  const dvec3 other = glm::cross(tangent, side);
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = two_pi * i / sides;
    const dvec2 on = on_circle(angle);
    const dvec3 normal = on.x * side + on.y * other;
    add_vertex(mesh, center + radius * normal, normal);
  }
  return first;
}

}  // namespace

void add_box(Mesh& mesh, const dvec3& low, const dvec3& high) {
  add_hexahedron(mesh, level_rectangle(low, high, low.y, 0.0), level_rectangle(low, high, high.y, 0.0));
}

void add_slab(Mesh& mesh, const dvec3& low, const dvec3& high, double bevel) {
  const auto shoulder = level_rectangle(low, high, high.y - bevel, 0.0);
  const auto top = level_rectangle(low, high, high.y, bevel);
  add_sides(mesh, level_rectangle(low, high, low.y, 0.0), shoulder);
  add_sides(mesh, shoulder, top);
  add_flat_quad(mesh, top);
}

void add_beam(Mesh& mesh, const dvec3& from, const dvec3& to, double width, double thickness, const dvec3& up) {
  const dvec3 along = glm::normalize(to - from);
  const dvec3 across = 0.5 * width * glm::normalize(glm::cross(along, up));
  const dvec3 above = 0.5 * thickness * glm::normalize(glm::cross(across, along));
  const auto section = [&](const dvec3& p) {
    return std::array<dvec3, 4>{p - across - above, p + across - above, p + across + above, p - across + above};
  };
  // The section is counter-clockwise seen against the beam's direction, so `from` takes the place of the top.
  add_hexahedron(mesh, section(to), section(from));
}

void add_tube(Mesh& mesh, std::span<const dvec3> path, std::span<const double> radii, int sides) {
  const size_t count = path.size();
  dvec3 side{0.0};
  uint32_t previous = 0;
  for (size_t i = 0; i < count; ++i) {
    const dvec3 before = i > 0 ? glm::normalize(path[i] - path[i - 1]) : dvec3{0.0};
    const dvec3 after = i + 1 < count ? glm::normalize(path[i + 1] - path[i]) : dvec3{0.0};
    const dvec3 tangent = glm::normalize(before + after);
    // Carrying the side direction along keeps the tube from twisting.
    const dvec3 carried = side - glm::dot(side, tangent) * tangent;
    const bool lost = i == 0 || glm::dot(carried, carried) < 1e-6;  // at a sharp turn into the side's own direction
    side = lost ? any_perpendicular(tangent) : glm::normalize(carried);
    const uint32_t ring = add_ring_vertices(mesh, path[i], side, tangent, radii[i], sides);
    if (i == 0) add_cap(mesh, ring, sides, -tangent, true);
    if (i + 1 == count) add_cap(mesh, ring, sides, tangent, false);
    if (i > 0) join_rings(mesh, previous, ring, sides);
    previous = ring;
  }
}

void add_tube(Mesh& mesh, std::span<const dvec3> path, double radius, int sides) {
  add_tube(mesh, path, std::vector<double>(path.size(), radius), sides);
}

void add_rod(Mesh& mesh, const dvec3& from, const dvec3& to, double radius, int sides) {
  add_tube(mesh, std::array{from, to}, radius, sides);
}

void add_ring(Mesh& mesh, const dvec3& center, const dvec3& axis, double ring_radius, double tube_radius, int segments,
              int sides) {
  const dvec3 u = any_perpendicular(axis), v = glm::cross(axis, u);
  const auto add_section = [&](int i) {
    const double angle = two_pi * i / segments;
    const dvec2 on = on_circle(angle);
    const dvec3 outward = on.x * u + on.y * v;
    return add_ring_vertices(mesh, center + ring_radius * outward, outward, glm::cross(axis, outward), tube_radius,
                             sides);
  };
  const uint32_t first = add_section(0);
  uint32_t previous = first;
  for (int i = 1; i < segments; ++i) {
    const uint32_t ring = add_section(i);
    join_rings(mesh, previous, ring, sides);
    previous = ring;
  }
  join_rings(mesh, previous, first, sides);
}

void add_lathe(Mesh& mesh, std::span<const dvec2> profile, int sides) {
  const auto edge_normal = [&](size_t i) {  // of the profile's edge from point i to i + 1; zero at a crease
    const dvec2 d = profile[i + 1] - profile[i];
    return d == dvec2{0.0} ? d : glm::normalize(dvec2{d.y, -d.x});
  };
  uint32_t previous = 0;
  for (size_t i = 0; i < profile.size(); ++i) {
    dvec2 normal{0.0};
    if (i > 0) normal += edge_normal(i - 1);
    if (i + 1 < profile.size()) normal += edge_normal(i);
    const bool pole = profile[i].x == 0.0;
    const uint32_t ring = static_cast<uint32_t>(mesh.positions.size());
    for (int k = 0; k < sides; ++k) {
      const double angle = two_pi * (pole ? k + 0.5 : k) / sides;
      const dvec2 around{sine(angle), cosine(angle)};
      const dvec2 p = profile[i];
      // A pole's own normal is the axis; averaged edges would tilt it.
      const dvec3 n = pole ? dvec3{0, normal.y, 0} : dvec3{normal.x * around.x, normal.y, normal.x * around.y};
      add_vertex(mesh, {p.x * around.x, p.y, p.x * around.y}, n);
    }
    if (i > 0 && profile[i] != profile[i - 1]) {
      for (int k = 0; k < sides; ++k) {
        const uint32_t a = static_cast<uint32_t>(k), b = static_cast<uint32_t>((k + 1) % sides);
        const bool from_pole = profile[i - 1].x == 0.0;
        if (!from_pole) add_triangle(mesh, previous + a, previous + b, ring + (pole ? a : b));
        if (!pole) add_triangle(mesh, previous + a, ring + b, ring + a);
      }
    }
    previous = ring;
  }
}

void add_sheet(Mesh& mesh, int segments_u, int segments_v, const std::function<dvec3(double, double)>& position) {
  constexpr double step = 1e-4;
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  for (int j = 0; j <= segments_v; ++j) {
    for (int i = 0; i <= segments_u; ++i) {
      const double u = static_cast<double>(i) / segments_u, v = static_cast<double>(j) / segments_v;
      const dvec3 along_u = position(u + step, v) - position(u - step, v);
      const dvec3 along_v = position(u, v + step) - position(u, v - step);
      add_vertex(mesh, position(u, v), glm::cross(along_u, along_v));
    }
  }
  const uint32_t row = static_cast<uint32_t>(segments_u) + 1;
  for (int j = 0; j < segments_v; ++j) {
    for (int i = 0; i < segments_u; ++i) {
      const uint32_t a = first + static_cast<uint32_t>(j) * row + static_cast<uint32_t>(i);
      add_triangle(mesh, a, a + 1, a + row + 1);
      add_triangle(mesh, a, a + row + 1, a + row);
    }
  }
}

}  // namespace izb::shapes

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "scene/garden_parts.h"
#include "scene/shapes.h"

namespace izb::garden {

using glm::dvec3;

namespace {

dvec3 level_direction(double angle) {
  return {std::cos(angle), 0, std::sin(angle)};
}

/// A blade of five triangles that tapers along a parabola: up at first, then over by `bend` times its length.
void add_blade(Mesh& mesh, const dvec3& root, double height, double width, double facing, double bend) {
  constexpr int levels = 3;
  const dvec3 over = level_direction(facing);
  // The sheet's own plane turns against the bend, so that neighbouring blades do not all show the same side.
  const dvec3 across = level_direction(facing + 0.5 * std::numbers::pi);
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  const auto add = [&](const dvec3& p, const dvec3& n) {
    mesh.positions.emplace_back(p);
    mesh.normals.emplace_back(n);
  };
  for (int i = 0; i <= levels; ++i) {
    const double t = static_cast<double>(i) / levels;
    const dvec3 centre = root + over * (bend * height * t * t) + dvec3{0, height * (t - 0.35 * bend * t * t), 0};
    const dvec3 tangent = over * (2.0 * bend * t) + dvec3{0, 1.0 - 0.7 * bend * t, 0};
    const dvec3 normal = glm::normalize(glm::cross(tangent, across));
    const double half = 0.5 * width * (1.0 - t * t * 0.55);
    if (i == levels) {
      add(centre, normal);
    } else {
      add(centre + across * half, normal);
      add(centre - across * half, normal);
    }
  }
  for (uint32_t i = 0; i + 1 < levels; ++i) {
    const uint32_t a = first + 2 * i;
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 2, a + 2, a + 1, a + 3});
  }
  const uint32_t last = first + 2 * (levels - 1);
  mesh.indices.insert(mesh.indices.end(), {last, last + 1, last + 2});
}

/// One order of branching, from the trunk to the twigs.
struct Order {
  int segments, sides, children, leaves;
  double wander;       ///< how far each segment turns from the one before
  double first_child;  ///< where along the branch the children begin, as a part of its length
};
constexpr std::array orders{Order{9, 12, 7, 0, 0.16, 0.38}, Order{7, 9, 6, 0, 0.21, 0.25},
                            Order{5, 7, 5, 0, 0.26, 0.25}, Order{4, 5, 4, 2, 0.31, 0.25},
                            Order{3, 3, 0, 5, 0.36, 0.25}};

class TreeBuilder {
 public:
  TreeBuilder(Tree& tree, Random& random) : tree_(tree), random_(random) {}

  /// A branch with all that grows on it; `rest` are its own order and those after it.
  void add_branch(const dvec3& root, dvec3 direction, double length, double radius, std::span<const Order> rest) {
    const Order& order = rest.front();
    const auto radius_at = [&](double t) { return radius * (1.0 - 0.72 * t); };
    std::vector<dvec3> path{root};
    std::vector<double> radii{radius};
    for (int i = 1; i <= order.segments; ++i) {
      direction = glm::normalize(direction + jitter(order.wander) + dvec3{0, 0.07, 0});  // up to the light
      path.push_back(path.back() + direction * (length / order.segments));
      radii.push_back(radius_at(static_cast<double>(i) / order.segments));
    }
    shapes::add_tube(tree_.wood, path, radii, order.sides);

    const auto segment_at = [&](double t) {
      return std::min(static_cast<size_t>(t * order.segments), path.size() - 2);
    };
    const auto point_at = [&](double t) {
      const size_t i = segment_at(t);
      return glm::mix(path[i], path[i + 1], t * order.segments - static_cast<double>(i));
    };
    double turn = random_.between(0.0, 6.28);
    for (int i = 0; i < order.children; ++i) {
      const double step = (i + random_.between(0.2, 0.8)) / order.children;
      const double t = glm::mix(order.first_child, 0.98, step);
      turn += 2.4 + random_.between(-0.4, 0.4);  // about the golden angle, as phyllotaxis has it
      const dvec3 axis = glm::normalize(path[segment_at(t) + 1] - path[segment_at(t)]);
      const dvec3 side = glm::normalize(glm::cross(axis, dvec3{0.31, 0.17, 0.94}));
      const dvec3 out = std::cos(turn) * side + std::sin(turn) * glm::cross(axis, side);
      const dvec3 heading = glm::normalize(axis + random_.between(0.75, 1.15) * out);
      const double share = random_.between(0.45, 0.66) * (1.0 - 0.3 * t);
      add_branch(point_at(t), heading, length * share, 0.68 * radius_at(t), rest.subspan(1));
    }
    for (int i = 0; i < order.leaves; ++i) {
      const dvec3 along = glm::normalize(direction + jitter(1.1));
      const dvec3 up = glm::normalize(jitter(1.0) + dvec3{0, 1.5, 0});
      const dvec3 across = glm::normalize(glm::cross(along, up));
      add_leaf(point_at(1.0 - 0.85 * i / order.leaves), along, across, random_.between(0.035, 0.065));
    }
  }

 private:
  dvec3 jitter(double size) {
    const double x = random_.between(-size, size), y = random_.between(-size, size);
    return {x, y, random_.between(-size, size)};
  }

  /// Two triangles folded along the midrib.
  void add_leaf(const dvec3& root, const dvec3& along, const dvec3& across, double length) {
    const dvec3 lift = 0.12 * length * glm::normalize(glm::cross(across, along));
    const dvec3 out = 0.24 * length * across, tip = root + along * length;
    const dvec3 middle = root + along * (0.45 * length) + lift;
    add_flat_triangle({root, middle + out, tip});
    add_flat_triangle({root, tip, middle - out});
  }

  void add_flat_triangle(const std::array<dvec3, 3>& corners) {
    Mesh& mesh = tree_.leaves;
    const dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const dvec3& p : corners) {
      mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
      mesh.positions.emplace_back(p);
      mesh.normals.emplace_back(normal);
    }
  }

  Tree& tree_;
  Random& random_;
};

}  // namespace

Mesh grass_patch(Random& random, double size, int blades, double shortest, double longest) {
  Mesh mesh;
  mesh.name = "grass";
  for (int i = 0; i < blades; ++i) {
    const double x = random.between(-size / 2, size / 2), z = random.between(-size / 2, size / 2);
    // Few long ones among many short ones.
    const double r = random.between(0, 1), height = shortest + (longest - shortest) * r * r;
    const double width = random.between(0.0035, 0.0065), facing = random.between(0, 6.2832);
    add_blade(mesh, {x, sunk - 0.02, z}, height, width, facing, random.between(0.1, 0.9));
  }
  return mesh;
}

Mesh grass_tuft(Random& random) {
  Mesh mesh;
  mesh.name = "tuft";
  for (int i = 0; i < 14; ++i) {
    const dvec3 root{random.between(-0.05, 0.05), sunk, random.between(-0.004, 0.004)};
    const double height = random.between(0.05, 0.16), width = random.between(0.003, 0.005);
    const double facing = random.between(0, 6.2832);
    add_blade(mesh, root, height, width, facing, random.between(0.3, 1.0));
  }
  return mesh;
}

Tree tree(Random& random) {
  Tree result;
  result.wood.name = "tree wood", result.leaves.name = "tree leaves";
  TreeBuilder{result, random}.add_branch({0, 4 * sunk, 0}, {0.05, 1, 0.02}, 4.6, 0.15, orders);
  return result;
}

}  // namespace izb::garden

// SPDX-License-Identifier: MIT
#include "scene/procedural.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "scene/random.h"
#include "scene/shapes.h"

namespace izb {
namespace {

using glm::dvec2;
using glm::dvec3;

struct Triangle {
  std::array<dvec3, 3> p;
  dvec3 normal;  ///< unit length
  std::string name;
};

Triangle triangle_of(const Mesh& mesh, size_t i, const glm::dmat4& world_from_object) {
  Triangle t;
  for (size_t k = 0; k < 3; ++k) {
    t.p[k] = dvec3{world_from_object * glm::dvec4{dvec3{mesh.positions[mesh.indices[3 * i + k]]}, 1.0}};
  }
  t.normal = glm::normalize(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]));
  t.name = mesh.name;
  return t;
}

/// Least altitude of a triangle.
double thickness(const Triangle& t) {
  const double area_2 = glm::length(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]));
  double longest = 0.0;
  for (size_t k = 0; k < 3; ++k) longest = std::max(longest, glm::length(t.p[(k + 1) % 3] - t.p[k]));
  return longest > 0.0 ? area_2 / longest : 0.0;
}

/// Edges (by position, to a nanometre) that are not met by exactly one edge of opposite direction; their end
/// points.
std::vector<std::array<dvec3, 2>> open_edges(const Mesh& mesh) {
  using Key = std::array<long long, 3>;
  const auto key = [](const glm::vec3& p) {
    return Key{std::llround(p.x * 1e9), std::llround(p.y * 1e9), std::llround(p.z * 1e9)};
  };
  std::map<std::pair<Key, Key>, std::pair<int, std::array<dvec3, 2>>> balance;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[next]];
    const bool forward = key(a) < key(b);
    auto& entry = balance[forward ? std::pair{key(a), key(b)} : std::pair{key(b), key(a)}];
    entry.first += forward ? 1 : -1;
    entry.second = {dvec3{a}, dvec3{b}};
  }
  std::vector<std::array<dvec3, 2>> open;
  for (const auto& [unused, entry] : balance) {
    if (entry.first != 0) open.push_back(entry.second);
  }
  return open;
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (size_t i = 0; i < mesh.triangle_count(); ++i) {
    const Triangle t = triangle_of(mesh, i, glm::dmat4{1.0});
    sum += glm::dot(t.p[0], glm::cross(t.p[1], t.p[2])) / 6.0;
  }
  return sum;
}

TEST(Random, GivesTheSequenceOfSplitMix64) {
  Random random{0};
  EXPECT_EQ(random.bits(), 0xe220a8397b1dcdafull);
  EXPECT_EQ(random.bits(), 0x6e789e6aa1b965f4ull);
  EXPECT_EQ(random.bits(), 0x06c45d188009454full);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.between(-2.0, 3.0);
    EXPECT_TRUE(x >= -2.0 && x < 3.0);
    EXPECT_LT(random.below(7), 7u);
  }
}

TEST(Shapes, AreClosedAndTurnOutward) {
  const auto expect_solid = [](const char* name, double expected_volume, const auto& add) {
    Mesh mesh;
    add(mesh);
    EXPECT_TRUE(open_edges(mesh).empty()) << name;
    EXPECT_NEAR(volume(mesh) / expected_volume, 1.0, 0.02) << name;
    for (size_t i = 0; i < mesh.triangle_count(); ++i) {
      const Triangle t = triangle_of(mesh, i, glm::dmat4{1.0});
      EXPECT_GT(thickness(t), 1e-4) << name;
      for (size_t k = 0; k < 3; ++k) EXPECT_GT(glm::dot(t.normal, dvec3{mesh.normals[mesh.indices[3 * i + k]]}), 0.5);
    }
  };
  const double pi = 3.14159265358979;
  expect_solid("box", 6.0, [](Mesh& m) { shapes::add_box(m, {0, 1, 2}, {1, 3, 5}); });
  expect_solid("beam", 0.5 * 0.2 * 5.0, [](Mesh& m) {
    shapes::add_beam(m, {1, 0, 0}, {1, 3, 4}, 0.5, 0.2, {0.3, 1, 0.1});
  });
  expect_solid("rod", pi * 0.01 * 3.0, [](Mesh& m) { shapes::add_rod(m, {0, 0, 0}, {1, 2, 2}, 0.1, 32); });
  expect_solid("bent tube", pi * 0.01 * 2.0, [](Mesh& m) {
    const std::array path{dvec3{0, 0, 0}, dvec3{0.5, 0, 0}, dvec3{1.0, 0.05, 0}, dvec3{1.5, 0.1, 0.05},
                          dvec3{2, 0.1, 0.05}};
    shapes::add_tube(m, path, 0.1, 32);
  });
  expect_solid("ring", 2 * pi * pi * 1.0 * 0.04, [](Mesh& m) {
    shapes::add_ring(m, {3, 2, 1}, glm::normalize(dvec3{1, 2, 3}), 1.0, 0.2, 64, 32);
  });
  expect_solid("cup", pi * (1.0 * 1.0 - 0.64 * 0.8), [](Mesh& m) {  // outside up, rim, inside down, creased
    const std::array profile{dvec2{0, 0},   dvec2{1, 0},   dvec2{1, 0},     dvec2{1, 1},     dvec2{1, 1},
                             dvec2{0.8, 1}, dvec2{0.8, 1}, dvec2{0.8, 0.2}, dvec2{0.8, 0.2}, dvec2{0, 0.2}};
    shapes::add_lathe(m, profile, 64);
  });
}

TEST(Shapes, SlabIsOpenBelowOnly) {
  Mesh mesh;
  shapes::add_slab(mesh, {0, -0.5, 0}, {2, 0, 1}, 0.1);
  const auto open = open_edges(mesh);
  EXPECT_EQ(open.size(), 4u);
  for (const auto& edge : open) EXPECT_TRUE(edge[0].y == -0.5 && edge[1].y == -0.5);
}

TEST(Procedural, TableNamesEachSceneOnce) {
  std::map<std::string, int> names;
  for (const Procedural& p : procedurals()) {
    EXPECT_FALSE(std::string{p.help}.empty());
    EXPECT_EQ(std::string{p.help}.find('\n'), std::string::npos);
    EXPECT_EQ(p.make(1, p.any_triangles ? 4000 : 0).name, p.name);
    ++names[p.name];
  }
  EXPECT_EQ(names.count("garden"), 1u);
  for (const auto& [name, count] : names) EXPECT_EQ(count, 1) << name;
}

TEST(Garden, SameSeedGivesTheSameScene) {
  const Scene a = make_garden(7), b = make_garden(7), c = make_garden(8);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  bool differs = false;
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
    EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices);
    differs = differs || a.meshes[i].positions != c.meshes[i].positions;
  }
  for (size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].world_from_object, b.instances[i].world_from_object);
  }
  EXPECT_TRUE(differs) << "the seed has no effect";
}

TEST(Garden, HasTheStatedSizeCamerasAndLight) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const Scene scene = make_garden(seed);
    EXPECT_GE(scene.triangle_count(), 100000u);
    EXPECT_LE(scene.triangle_count(), 300000u);
    std::vector<std::string> cameras;
    for (const Camera& camera : scene.cameras) {
      cameras.push_back(camera.name);
      const glm::dmat3 turn{camera.world_from_view};
      EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-12);
      EXPECT_NEAR(glm::length(turn[0]), 1.0, 1e-12);
      EXPECT_GT(camera.world_from_view[3].y, 0.1);
    }
    EXPECT_EQ(cameras, (std::vector<std::string>{"main", "wires", "grass", "contact"}));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "sunset");
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    const dvec3 d = scene.lights[0].direction_ws;
    EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    EXPECT_TRUE(d.y < -std::sin(8.0 * 0.0174533) && d.y > -std::sin(12.0 * 0.0174533)) << "not a low sun";
  }
}

TEST(Garden, MeshesAreCleanTriangleLists) {
  const Scene scene = make_garden(1);
  std::vector<bool> placed(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size());
    placed[instance.mesh] = true;
    const glm::dmat3 turn{instance.world_from_object};
    EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-12) << "tests below take object space for rigidly moved world space";
  }
  EXPECT_TRUE(std::find(placed.begin(), placed.end(), false) == placed.end()) << "a mesh is never placed";
  for (const Mesh& mesh : scene.meshes) {
    ASSERT_LT(mesh.material, scene.materials.size()) << mesh.name;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
    ASSERT_EQ(mesh.indices.size() % 3, 0u) << mesh.name;
    for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f) << mesh.name;
    for (const glm::vec3& p : mesh.positions) ASSERT_LT(glm::length(p), 100.0f) << mesh.name;
    for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size()) << mesh.name;
    for (size_t i = 0; i < mesh.triangle_count(); ++i) {
      const Triangle t = triangle_of(mesh, i, glm::dmat4{1.0});
      ASSERT_GT(thickness(t), 1e-4) << mesh.name << " triangle " << i;
      for (size_t k = 0; k < 3; ++k) {
        ASSERT_GT(glm::dot(t.normal, dvec3{mesh.normals[mesh.indices[3 * i + k]]}), 0.0)
            << mesh.name << " triangle " << i << ": normals disagree with the winding";
      }
    }
  }
}

TEST(Garden, SingleSidedBodiesAreClosedOrOpenUnderTheFloorOnly) {
  const Scene scene = make_garden(1);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].double_sided) continue;
    for (const auto& edge : open_edges(mesh)) {
      for (const dvec3& p : edge) {
        ASSERT_LT((instance.world_from_object * glm::dvec4{p, 1.0}).y, -0.02) << mesh.name << " has a hole";
      }
    }
  }
}

/// Whether two triangles in one plane overlap by more than `tolerance`: no edge of either separates them.
bool overlap_in_plane(const Triangle& a, const Triangle& b, double tolerance) {
  for (const Triangle* t : {&a, &b}) {
    for (size_t k = 0; k < 3; ++k) {
      const dvec3 axis = glm::normalize(glm::cross(t->normal, t->p[(k + 1) % 3] - t->p[k]));
      std::array<dvec2, 2> range{dvec2{1e30, -1e30}, dvec2{1e30, -1e30}};
      for (size_t i = 0; i < 3; ++i) {
        const double da = glm::dot(axis, a.p[i]), db = glm::dot(axis, b.p[i]);
        range[0] = {std::min(range[0].x, da), std::max(range[0].y, da)};
        range[1] = {std::min(range[1].x, db), std::max(range[1].y, db)};
      }
      if (range[0].y < range[1].x + tolerance || range[1].y < range[0].x + tolerance) return false;
    }
  }
  return true;
}

TEST(Garden, NoTwoFacesOverlapInOnePlane) {
  const Scene scene = make_garden(1);
  constexpr double plane_distance = 5e-5, tolerance = 2e-5;
  using Plane = std::tuple<long, long, long, long>;  // normal in thousandths, offset in steps of 2 * plane_distance
  std::map<Plane, std::vector<Triangle>> by_plane;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].double_sided) continue;  // blades and leaves lie in no common planes
    for (size_t i = 0; i < mesh.triangle_count(); ++i) {
      Triangle t = triangle_of(mesh, i, instance.world_from_object);
      dvec3 n = t.normal;
      const double sign = n.x > 1e-3 || (n.x > -1e-3 && (n.y > 1e-3 || (n.y > -1e-3 && n.z > 0))) ? 1.0 : -1.0;
      n *= sign;
      const double offset = glm::dot(n, t.p[0]) / (2.0 * plane_distance);
      const auto [x, y, z] = std::tuple{std::lround(n.x * 1e3), std::lround(n.y * 1e3), std::lround(n.z * 1e3)};
      by_plane[{x, y, z, std::lround(std::floor(offset))}].push_back(t);
      by_plane[{x, y, z, std::lround(std::floor(offset + 0.5)) + 1000000000L}].push_back(std::move(t));
    }
  }
  std::set<std::string> overlaps;
  for (const auto& [plane, triangles] : by_plane) {
    for (size_t i = 0; i < triangles.size(); ++i) {
      for (size_t k = i + 1; k < triangles.size(); ++k) {
        const Triangle &a = triangles[i], &b = triangles[k];
        if (std::abs(glm::dot(a.normal, b.p[0] - a.p[0])) > plane_distance) continue;
        if (std::abs(glm::dot(a.normal, b.normal)) < 1.0 - 1e-7) continue;
        if (!overlap_in_plane(a, b, tolerance)) continue;
        overlaps.insert(
            fmt::format("{} and {} in the plane through ({:.3f}, {:.3f}, {:.3f}) with normal ({:.3f}, {:.3f}, {:.3f})",
                        a.name, b.name, a.p[0].x, a.p[0].y, a.p[0].z, a.normal.x, a.normal.y, a.normal.z));
      }
    }
  }
  EXPECT_TRUE(overlaps.empty()) << fmt::format("{}", fmt::join(overlaps, "\n"));
}

}  // namespace
}  // namespace izb

// SPDX-License-Identifier: MIT
// What holds for every scene that is made with any number of triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "scene/glb_writer.h"
#include "scene/portable_math.h"
#include "scene/pose.h"
#include "scene/procedural.h"

namespace izb {

void PrintTo(const Procedural& scene, std::ostream* out) {
  *out << scene.name;
}

namespace {

using glm::dvec3;

/// Those of any number of triangles; `names`: only these.
std::vector<Procedural> sized_scenes(const std::set<std::string>& names = {}) {
  std::vector<Procedural> all;
  for (const Procedural& p : procedurals())
    if (p.any_triangles && (names.empty() || names.contains(p.name))) all.push_back(p);
  return all;
}

class ProceduralScenes : public testing::TestWithParam<Procedural> {};

const Camera* camera_named(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == name) return &camera;
  return nullptr;
}

void expect_clean(const Scene& scene) {
  std::set<uint32_t> placed;
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    placed.insert(instance.mesh);
    for (const glm::vec3& p : scene.meshes[instance.mesh].positions)
      bounds.add(dvec3{instance.world_from_object * glm::dvec4{dvec3{p}, 1.0}});
  }
  EXPECT_TRUE(std::isfinite(bounds.radius()));
  EXPECT_LT(bounds.radius(), 6000.0);
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    EXPECT_EQ(placed.count(uint32_t(m)), 1u) << mesh.name << " is never placed";
    ASSERT_LT(mesh.material, scene.materials.size()) << mesh.name;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
    size_t bad_normals = 0, bad_positions = 0, flat = 0, turned = 0;
    for (const glm::vec3& n : mesh.normals) bad_normals += std::abs(glm::length(n) - 1.0f) < 1e-5f ? 0 : 1;
    for (const glm::vec3& p : mesh.positions) bad_positions += std::isfinite(p.x + p.y + p.z) ? 0 : 1;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      for (size_t k = 0; k < 3; ++k) ASSERT_LT(mesh.indices[i + k], mesh.positions.size()) << mesh.name;
      const dvec3 a{mesh.positions[mesh.indices[i]]};
      const dvec3 normal =
          glm::cross(dvec3{mesh.positions[mesh.indices[i + 1]]} - a, dvec3{mesh.positions[mesh.indices[i + 2]]} - a);
      flat += glm::length(normal) > 0.0 ? 0 : 1;
      dvec3 smooth{0.0};
      for (size_t k = 0; k < 3; ++k) smooth += dvec3{mesh.normals[mesh.indices[i + k]]};
      turned += glm::dot(normal, smooth) < 0.0 ? 1 : 0;
    }
    EXPECT_EQ(bad_normals, 0u) << mesh.name;
    EXPECT_EQ(bad_positions, 0u) << mesh.name;
    EXPECT_EQ(flat, 0u) << mesh.name << " has triangles without area";
    EXPECT_LE(turned, 5 + mesh.triangle_count() / 50) << mesh.name << ": normals disagree with the winding";
    for (size_t v = 0; mesh.influences > 0 && v < mesh.positions.size(); ++v) {
      float sum = 0.0f;
      for (size_t k = 0; k < mesh.influences; ++k) sum += mesh.weights[v * mesh.influences + k];
      ASSERT_NEAR(sum, 1.0f, 1e-5f) << mesh.name;
    }
  }
}

TEST_P(ProceduralScenes, HasTheNumberOfTrianglesAskedFor) {
  const Procedural& p = GetParam();
  for (const size_t wanted : {size_t{6000}, size_t{100000}}) {
    const Scene scene = p.make(1, wanted);
    EXPECT_NEAR(double(scene.triangle_count()) / double(wanted), 1.0, 0.10) << wanted;
    expect_clean(scene);
  }
  if (p.triangles > 700000) return;
  EXPECT_NEAR(double(p.make(1).triangle_count()) / double(p.triangles), 1.0, 0.02);
}

// All of them have something that is drawn by chance.
TEST_P(ProceduralScenes, SameSeedGivesTheSameBytes) {
  const Procedural& p = GetParam();
  const std::vector<uint8_t> bytes = to_glb(p.make(3, 6000));
  EXPECT_EQ(bytes, to_glb(p.make(3, 6000)));
  EXPECT_NE(bytes, to_glb(p.make(4, 6000))) << "the seed has no effect";
}

TEST_P(ProceduralScenes, HasACameraALightAndAPath) {
  Scene scene = GetParam().make(1, 6000);
  ASSERT_GE(scene.lights.size(), 1u);
  ASSERT_GE(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "main");
  EXPECT_EQ(scene.cameras[0].node, -1) << "it must not move";
  const Camera* const path = camera_named(scene, "path");
  ASSERT_TRUE(path && path->node >= 0);
  EXPECT_EQ(scene.nodes[size_t(path->node)].name, "path");
  const auto animation = std::find_if(scene.animations.begin(), scene.animations.end(),
                                      [](const Animation& a) { return a.name == "path"; });
  ASSERT_NE(animation, scene.animations.end());
  EXPECT_TRUE(animation->length_s >= 10.0 && animation->length_s <= 20.0);
  Poser poser{scene};
  std::vector<dvec3> way;
  double length = 0.0, longest = 0.0;
  for (int k = 0; k <= 200; ++k) {
    poser.at({"path", animation->length_s * k / 200});
    Camera camera = *path;
    poser.place(camera);
    way.emplace_back(camera.world_from_view[3]);
    EXPECT_NEAR(glm::determinant(glm::dmat3{camera.world_from_view}), 1.0, 1e-6);
    if (k == 0) continue;
    const double step = glm::length(way[size_t(k)] - way[size_t(k) - 1]);
    length += step;
    longest = std::max(longest, step);
  }
  EXPECT_GT(length, 3.0);
  EXPECT_LT(longest, 5.0 * length / 200) << "a jump";
}

class DeformingScenes : public testing::TestWithParam<Procedural> {};

TEST_P(DeformingScenes, StayInOnePieceAndLoop) {
  Scene scene = GetParam().make(1, 20000);
  ASSERT_FALSE(scene.skins.empty());
  const Animation motion = scene.animations.front();
  EXPECT_NE(motion.name, "path");
  Poser poser{scene};
  const auto positions_at = [&](double time_s) {
    poser.at({motion.name, time_s});
    std::vector<dvec3> all;
    for (const Instance& instance : scene.instances)
      if (instance.skin >= 0)
        for (const dvec3& p : posed_positions_ws(scene, instance)) all.push_back(p);
    return all;
  };
  const std::vector<dvec3> start = positions_at(0.0), middle = positions_at(0.4 * motion.length_s),
                           end = positions_at(motion.length_s);
  double moved = 0.0, gap = 0.0;
  for (size_t i = 0; i < start.size(); ++i) {
    ASSERT_LT(glm::length(middle[i]), 20.0);
    moved = std::max(moved, glm::length(middle[i] - start[i]));
    gap = std::max(gap, glm::length(end[i] - start[i]));
  }
  EXPECT_GT(moved, 0.2);
  EXPECT_LT(gap, 1e-4) << "the loop does not close";
}

INSTANTIATE_TEST_SUITE_P(All, DeformingScenes, testing::ValuesIn(sized_scenes({"tentacles", "character"})),
                         [](const auto& scene) { return std::string{scene.param.name}; });

INSTANTIATE_TEST_SUITE_P(All, ProceduralScenes, testing::ValuesIn(sized_scenes()),
                         [](const auto& scene) { return std::string{scene.param.name}; });

TEST(PortableMath, AgreesWithTheLibrary) {
  for (int i = -2000; i <= 2000; ++i) {
    const double x = 0.0137 * i * std::abs(i);
    EXPECT_NEAR(sine(x), std::sin(x), 4e-15 + 1e-16 * std::abs(x)) << x;
    EXPECT_NEAR(cosine(x), std::cos(x), 4e-15 + 1e-16 * std::abs(x)) << x;
  }
  EXPECT_EQ(on_circle(0.0), (glm::dvec2{1.0, 0.0}));
}

}  // namespace
}  // namespace izb

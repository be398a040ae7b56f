// SPDX-License-Identifier: MIT
// Meshes that deform: the GPU's vertices against double precision, and masks against the same shape standing still.
#include "frame/deform_check.h"
#include "gl/frame_fixture.h"
#include "scene/pose.h"

namespace izb::test {
namespace {

glm::vec3 random_vec(Random& random, double size) {
  const glm::dvec3 p = random.point(size);
  return glm::vec3(p);
}

/// Triangles that two joints and two targets move: a mesh of `vertices` in random places, influences each.
Mesh flexible(uint32_t seed, uint32_t vertices, uint32_t influences, bool morphs) {
  Random random(seed);
  Mesh mesh;
  for (uint32_t i = 0; i < vertices; ++i) {
    mesh.positions.push_back(random_vec(random, 1.5) + glm::vec3(0.0f, 1.6f, 0.0f));
    mesh.normals.push_back(glm::normalize(random_vec(random, 1.0)));
    mesh.indices.push_back(i);
    float rest = 1.0f;
    for (uint32_t k = 0; k < influences; ++k) {
      const float weight = k + 1 == influences ? rest : rest * 0.6f;
      mesh.joints.push_back(static_cast<uint16_t>((i + k) % 3));
      mesh.weights.push_back(weight);
      rest -= weight;
    }
  }
  mesh.influences = influences;
  for (int t = 0; morphs && t < 2; ++t) {
    MorphTarget target;
    for (uint32_t i = 0; i < vertices; ++i) target.positions.push_back(random_vec(random, 0.5));
    if (t == 0) target.normals = std::vector<glm::vec3>(vertices, glm::vec3(0.1f, 0.0f, 0.2f));
    mesh.targets.push_back(std::move(target));
  }
  return mesh;
}

/// A floor, a rigid mesh, one mesh morphed twice with different weights, one skinned, one morphed and skinned.
Scene flexible_scene(const glm::dvec3& offset = glm::dvec3(0.0)) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(9.0f, 2));
  scene.instances.back().world_from_object = glm::translate(glm::dmat4(1.0), offset);
  const glm::dmat4 root = glm::translate(glm::dmat4(1.0), offset);
  for (int j = 0; j < 3; ++j) {
    Node joint;
    joint.parent = j - 1;
    joint.translation = j == 0 ? offset + glm::dvec3(0.3, 0.2, -0.1) : glm::dvec3(0.2, 0.5, 0.1);
    joint.rotation = glm::angleAxis(0.4 * j + 0.2, glm::normalize(glm::dvec3(1.0, j, 0.5)));
    scene.nodes.push_back(joint);
  }
  Node holder;
  holder.matrix = glm::rotate(root, 0.3, glm::dvec3(0.0, 1.0, 0.0));
  scene.nodes.push_back(holder);
  Skin skin;
  for (uint32_t j = 0; j < 3; ++j) {
    skin.joints.push_back(j);
    skin.joint_from_bind.push_back(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.3, -0.4 * j, 0.2)));
  }
  scene.skins.push_back(skin);
  const auto add = [&](Mesh mesh, std::vector<std::vector<double>> weights, int its_skin) {
    scene.meshes.push_back(std::move(mesh));
    for (const std::vector<double>& w : weights) {
      Instance instance;
      instance.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
      instance.node = 3;
      if (!w.empty()) {
        Node own;
        own.parent = 3;
        own.translation = {0.3 * w[0], 0.0, w[0]};
        own.morph_weights = w;
        instance.node = static_cast<int>(scene.nodes.size());
        scene.nodes.push_back(own);
        instance.morph_weights.resize(w.size());
      }
      instance.skin = its_skin;
      scene.instances.push_back(instance);
    }
  };
  add(flexible(1, 90, 0, false), {{}}, -1);
  add(flexible(2, 99, 0, true), {{0.5, -1.25}, {0.0, 0.75}}, -1);
  add(flexible(3, 207, 3, false), {{}}, 0);
  add(flexible(4, 63, 2, true), {{0.3, 0.6}}, 0);
  Poser(scene).at_rest();
  return scene;
}

/// The same triangles without anything that deforms.
Scene baked(const Scene& scene) {
  Scene still = scene;
  still.meshes.clear();
  for (Instance& instance : still.instances) {
    Mesh mesh = scene.meshes[instance.mesh];
    mesh.positions = deformed_positions(scene, instance);
    mesh.targets.clear();
    mesh.influences = 0;
    instance.mesh = static_cast<uint32_t>(still.meshes.size());
    instance.skin = -1;
    instance.morph_weights.clear();
    still.meshes.push_back(std::move(mesh));
  }
  return still;
}

const Camera camera = look_at({3.5, 4.0, 6.0}, {0.2, 1.0, 0.0}, glm::radians(50.0));

TEST(Deform, VerticesAreWhereDoublePrecisionPutsThem) {
  for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(1e6, -2e6, 1e6)}) {
    const Scene scene = flexible_scene(offset);
    SceneBuffers buffers(scene, make_draw_list(scene), capabilities());
    buffers.update(scene, make_instance_frames(camera, scene, buffers.draw_list()));
    const DeformCheck check = check_deformation(scene, buffers);
    EXPECT_EQ(check.vertices, 2u * 99u + 207u + 63u);
    EXPECT_EQ(check.wrong, 0u);
    EXPECT_EQ(check.not_as_on_cpu, 0u);
    EXPECT_GT(check.largest_error, 0.0);
  }
}

TEST(Deform, TheCheckSeesAWrongVertex) {
  Scene scene = flexible_scene();
  SceneBuffers buffers(scene, make_draw_list(scene), capabilities());
  buffers.update(scene, make_instance_frames(camera, scene, buffers.draw_list()));
  scene.skins[0].world_from_bind[1][3].x += 1e-5;
  const DeformCheck check = check_deformation(scene, buffers);
  EXPECT_GT(check.wrong, 100u);
  EXPECT_LE(check.wrong, 270u);
}

TEST(Deform, NormalsFollow) {
  const Scene scene = flexible_scene();
  SceneBuffers buffers(scene, make_draw_list(scene), capabilities());
  buffers.update(scene, make_instance_frames(camera, scene, buffers.draw_list()));
  const DrawList& list = buffers.draw_list();
  for (const DrawPart& part : list.parts) {
    const Instance& instance = scene.instances[part.instance];
    if (!instance.deforms()) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    std::vector<glm::vec3> found(mesh.normals.size());
    buffers.normals().read_bytes(part.base_vertex * sizeof(glm::vec3), found.size() * sizeof(glm::vec3), found.data());
    for (size_t v = 0; v < found.size(); ++v) {
      glm::dvec3 n(mesh.normals[v]);
      for (size_t t = 0; t < instance.morph_weights.size(); ++t)
        if (!mesh.targets[t].normals.empty())
          n += double(instance.morph_weights[t]) * glm::dvec3(mesh.targets[t].normals[v]);
      if (instance.skin >= 0) {
        glm::dmat3 blend(0.0);
        for (size_t k = v * mesh.influences; k < (v + 1) * mesh.influences; ++k)
          blend += double(mesh.weights[k]) * glm::dmat3(scene.skins[0].world_from_bind[mesh.joints[k]]);
        n = glm::inverse(glm::transpose(blend)) * n;
      }
      EXPECT_NEAR(glm::dot(glm::normalize(n), glm::normalize(glm::dvec3(found[v]))), 1.0, 1e-5)
          << part.instance << " " << v;
    }
  }
}

TEST(Deform, TheMaskIsThatOfTheSameShapeStandingStill) {
  const Scene scene = flexible_scene();
  for (const char* spp : {"1", "32"}) {
    const Settings settings{{"spp", spp}, {"coverage", "exact"}, {"grid", "128"}};
    const Frame moving = render_frame(scene, camera, sun(130, 40), 96, 64, settings);
    const Frame still = render_frame(baked(scene), camera, sun(130, 40), 96, 64, settings);
    EXPECT_EQ(different(moving.mask, still.mask), 0u);
    EXPECT_GT(shadowed(moving), 100u);
    const auto sorted = [](std::vector<glm::vec3> corners) {
      std::sort(corners.begin(), corners.end(), [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
      });
      return corners;
    };
    EXPECT_EQ(sorted(moving.triangles_vs), sorted(still.triangles_vs));
    expect_explained(moving);
  }
}

TEST(Deform, TheDepthMapIsThatOfTheSameShapeStandingStill) {
  const Scene scene = flexible_scene();
  const Settings settings{{"spp", "32"}, {"filter", "none"}, {"resolution", "256"}, {"cascades", "2"}};
  for (const Light& light : {sun(130, 40), point_light({1.0, 4.0, 2.0})}) {
    const Frame moving = render_frame(scene, camera, light, 96, 64, settings, "shadow_map");
    EXPECT_EQ(different(moving.mask, render_frame(baked(scene), camera, light, 96, 64, settings, "shadow_map").mask),
              0u);
    EXPECT_GT(shadowed(moving), 100u);
  }
}

/// Its animation "move" deforms it and moves its parts.
Scene moving_scene() {
  Scene scene = flexible_scene();
  Animation move;
  move.name = "move";
  const auto track = [&](uint32_t node, AnimatedProperty property, std::vector<float> values) {
    Track t;
    t.node = node;
    t.property = property;
    t.times_s = {0.0f, 2.0f};
    t.values = std::move(values);
    move.tracks.push_back(t);
  };
  track(0, AnimatedProperty::translation, {0, 0, 0, 0.5f, 0.5f, 0.5f});
  track(1, AnimatedProperty::rotation, {0, 0, 0, 1, 0, 1, 0, 0});
  track(5, AnimatedProperty::morph_weights, {0, 1, 1, 0});
  track(4, AnimatedProperty::scale, {1, 1, 1, 2, 0.5f, 1});
  scene.animations.push_back(move);
  return scene;
}

TEST(Deform, BoundsOfAPoseHoldItsVertices) {
  Scene scene = moving_scene();
  const PosedBounds posed(scene);
  Poser poser(scene);
  for (const double time_s : {0.0, 0.7, 2.0}) {
    poser.at({"", time_s});
    const Bounds exact = world_bounds(scene), boxes = posed.of(scene);
    // Joints' weights are floats: their sum is 1 but for their rounding.
    const double slack = 1e-5;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(boxes.min, exact.min + slack))) << time_s;
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(boxes.max, exact.max - slack))) << time_s;
    EXPECT_LT(boxes.radius(), 4.0 * exact.radius()) << time_s;
  }
}

void expect_posed_as_loaded(const std::string& name, const Settings& settings) {
  Scene scene = moving_scene();
  const auto technique = make_technique(name);
  set_options(*technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, 96, 64, {sun(130, 40)});
  Poser poser(scene);
  std::vector<std::vector<uint32_t>> masks;
  for (const double time_s : {0.0, 1.2, 2.0}) {
    poser.at({"", time_s});
    masks.push_back(render_frame(renderer, *technique, camera, sun(130, 40)).mask);
    const Frame alone = render_frame(scene, camera, sun(130, 40), 96, 64, settings, name);
    EXPECT_EQ(different(masks.back(), alone.mask), 0u) << time_s;
  }
  EXPECT_GT(different(masks[0], masks[1]), 100u);
  EXPECT_GT(different(masks[1], masks[2]), 100u);
  poser.at({"", 1.2});  // and back
  EXPECT_EQ(different(render_frame(renderer, *technique, camera, sun(130, 40)).mask, masks[1]), 0u);
}

TEST(Deform, PosedAnewIsAsLoadedSo) {
  expect_posed_as_loaded("izb", {{"spp", "32"}, {"grid", "128"}});
  for (const char* fit : {"receivers", "camera", "stable"})
    expect_posed_as_loaded("shadow_map", {{"fit", fit}, {"cascades", "3"}, {"resolution", "256"}});
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
#include "scene/glb_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "full_device.h"
#include "scene/gltf.h"
#include "scene/procedural.h"

namespace izb {
namespace {

namespace fs = std::filesystem;

class GlbWriter : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::path(testing::TempDir()) /
             (std::string{"izb_glb_"} + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
};

/// One of everything that the writer knows, with values that no default would give back.
Scene small_scene() {
  Scene scene;
  scene.name = "small";
  Material plain;
  plain.name = "plain";
  plain.base_color = {0.1f, 0.2f, 0.3f, 1.0f};
  plain.metallic = 0.0f;
  plain.roughness = 0.7f;
  Material cut = plain;
  cut.name = "cut";
  cut.alpha_mode = AlphaMode::mask;
  cut.alpha_cutoff = 0.25f;
  cut.double_sided = true;
  scene.materials = {plain, cut};

  Mesh bare;
  bare.name = "bare";
  bare.positions = {{0, 0, 0}, {1, 0, 0.1f}, {0, 1, -0.3f}, {1, 1, 1e-3f}};
  bare.indices = {0, 1, 2, 2, 1, 3};
  bare.material = 1;
  Mesh full = bare;
  full.name = "full";
  full.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  full.uvs = {{0, 0}, {0.5f, 0}, {0, 0.25f}, {0.5f, 0.75f}};
  full.material = 0;
  scene.meshes = {bare, full};
  glm::dmat4 moved{1.0};
  moved[0] = {0, 0, -2.0 / 3.0, 0};
  moved[2] = {2.0 / 3.0, 0, 0, 0};
  moved[3] = {1.0 / 3.0, -7.0, 0.1, 1};
  scene.instances = {{0, glm::dmat4{1.0}}, {1, moved}, {0, moved}};

  Camera perspective;
  perspective.name = "eye";
  perspective.world_from_view = moved;
  perspective.world_from_view[0] = {0, 0, -1, 0};
  perspective.world_from_view[2] = {1, 0, 0, 0};
  perspective.yfov_rad = 0.6;
  perspective.near_plane = 0.125;
  Camera orthographic;
  orthographic.name = "plan";
  orthographic.orthographic = true;
  orthographic.ymag = 3.5;
  orthographic.near_plane = 0.5;
  orthographic.far_plane = 90.0;
  scene.cameras = {perspective, orthographic};

  Light sun;
  sun.name = "sun";
  sun.direction_ws = glm::normalize(glm::dvec3{0.7, -0.2, -0.4});
  sun.color = {1.0f, 0.5f, 0.25f};
  sun.intensity = 3.0f;
  Light spot = sun;
  spot.name = "spot";
  spot.type = LightType::spot;
  spot.direction_ws = {0, -1, 0};
  spot.position_ws = {1.0 / 3.0, 4, 5};
  spot.inner_cone_rad = 0.2;
  spot.outer_cone_rad = 0.5;
  scene.lights = {sun, spot};
  return scene;
}

void expect_same(const glm::dmat4& a, const glm::dmat4& b) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) EXPECT_NEAR(a[column][row], b[column][row], 1e-12) << column << ' ' << row;
  }
}

/// Every field that a renderer reads, compared exactly where the file holds the bits.
void expect_same(const Scene& written, const Scene& read) {
  ASSERT_EQ(written.meshes.size(), read.meshes.size());  // shared, in whichever order
  ASSERT_EQ(written.instances.size(), read.instances.size());
  for (size_t i = 0; i < written.instances.size(); ++i) {
    EXPECT_EQ(written.instances[i].skin, read.instances[i].skin);
    if (written.instances[i].skin < 0)
      expect_same(written.instances[i].world_from_object, read.instances[i].world_from_object);
    const Mesh& a = written.meshes[written.instances[i].mesh];
    const Mesh& b = read.meshes[read.instances[i].mesh];
    EXPECT_EQ(a.positions, b.positions) << a.name;
    EXPECT_EQ(a.normals.size(), b.normals.size()) << a.name;
    for (size_t k = 0; k < std::min(a.normals.size(), b.normals.size()); ++k) {
      ASSERT_LT(glm::length(a.normals[k] - b.normals[k]), 1e-6f) << a.name;
    }
    EXPECT_EQ(a.indices, b.indices) << a.name;
    EXPECT_EQ(written.materials[a.material].name, read.materials[b.material].name);
  }
  ASSERT_LE(written.materials.size(), read.materials.size());  // a loader may append a default material
  for (size_t i = 0; i < written.materials.size(); ++i) {
    const Material &a = written.materials[i], &b = read.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.roughness, b.roughness);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
    EXPECT_EQ(a.double_sided, b.double_sided);
  }
  ASSERT_EQ(written.cameras.size(), read.cameras.size());
  for (size_t i = 0; i < written.cameras.size(); ++i) {
    const Camera &a = written.cameras[i], &b = read.cameras[i];
    EXPECT_EQ(a.name, b.name);
    expect_same(a.world_from_view, b.world_from_view);
    EXPECT_EQ(a.orthographic, b.orthographic);
    if (a.orthographic) {
      EXPECT_DOUBLE_EQ(a.ymag, b.ymag);
    } else {
      EXPECT_DOUBLE_EQ(a.yfov_rad, b.yfov_rad);
    }
    EXPECT_DOUBLE_EQ(a.near_plane, b.near_plane);
    EXPECT_DOUBLE_EQ(a.far_plane, b.far_plane);
  }
  ASSERT_EQ(written.lights.size(), read.lights.size());
  for (size_t i = 0; i < written.lights.size(); ++i) {
    const Light &a = written.lights[i], &b = read.lights[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type);
    EXPECT_LT(glm::length(a.direction_ws - b.direction_ws), 1e-12);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.intensity, b.intensity);
    if (a.type == LightType::directional) continue;
    EXPECT_LT(glm::length(a.position_ws - b.position_ws), 1e-12);
    EXPECT_DOUBLE_EQ(a.inner_cone_rad, b.inner_cone_rad);
    EXPECT_DOUBLE_EQ(a.outer_cone_rad, b.outer_cone_rad);
  }
}

TEST_F(GlbWriter, LoaderReadsBackWhatWasWritten) {
  const Scene scene = small_scene();
  write_glb(scene, folder / "small.glb");
  const Scene read = load_gltf(folder / "small.glb");
  EXPECT_EQ(read.name, "small");
  expect_same(scene, read);
}

TEST_F(GlbWriter, LoaderReadsBackEveryProceduralScene) {
  for (const Procedural& procedural : procedurals()) {
    const Scene scene = procedural.make(1, procedural.any_triangles ? 6000 : 0);
    const fs::path path = folder / (std::string{procedural.name} + ".glb");
    write_glb(scene, path);
    const Scene read = load_gltf(path);
    expect_same(scene, read);
    EXPECT_EQ(scene.triangle_count(), read.triangle_count());
    for (const std::string& sentence : read.ignored)  // only that nothing plays
      EXPECT_TRUE(sentence.starts_with("animations:") || sentence.starts_with("skinned primitives:")) << sentence;
  }
}

/// A chain of two joints that bends a strip; a node that carries a camera, a lamp and a mesh whose shape changes.
Scene moving_scene() {
  Scene scene = small_scene();
  scene.nodes.resize(3);
  scene.nodes[0].name = "carrier";
  scene.nodes[0].translation = {1, 2, 3};
  scene.nodes[0].rotation = glm::normalize(glm::dquat{0.5, 0.25, -0.5, 0.125});
  scene.nodes[0].morph_weights = {0.25};
  scene.nodes[1].name = "root";
  scene.nodes[1].scale = {2, 1, 1};
  scene.nodes[2].name = "tip";
  scene.nodes[2].parent = 1;
  scene.nodes[2].translation = {0, 0.5, 0};
  scene.cameras[0].node = scene.lights[1].node = 0;

  Mesh shape = scene.meshes[0];
  shape.name = "shape";
  shape.targets.resize(1);
  shape.targets[0].positions = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}};
  Mesh strip = scene.meshes[0];
  strip.name = "strip";
  strip.influences = 2;
  strip.joints = {0, 0, 0, 0, 0, 1, 1, 0};
  strip.weights = {1, 0, 1, 0, 0.25f, 0.75f, 1, 0};
  scene.meshes.insert(scene.meshes.end(), {shape, strip});
  Instance carried, bent;
  carried.mesh = 2, carried.node = 0, carried.morph_weights = {0.25f};
  bent.mesh = 3, bent.skin = 0;
  scene.instances.insert(scene.instances.end(), {carried, bent});
  Skin skin;
  skin.joints = {1, 2};
  skin.joint_from_bind.assign(2, glm::dmat4{1.0});
  skin.joint_from_bind[1][3] = {0, -0.5, 0, 1};
  skin.world_from_bind.assign(2, glm::dmat4{1.0});
  scene.skins = {skin};

  Animation bend;
  bend.name = "bend";
  bend.length_s = 2.0;
  bend.tracks.push_back({2, AnimatedProperty::rotation, Interpolation::linear, {0, 2}, {0, 0, 0, 1, 0, 1, 0, 0}});
  bend.tracks.push_back({1, AnimatedProperty::scale, Interpolation::step, {0, 1}, {2, 1, 1, 1, 1, 1}});
  bend.tracks.push_back({0, AnimatedProperty::morph_weights, Interpolation::cubic_spline, {0.5f}, {0, 1, 0}});
  Animation shift;
  shift.name = "shift";
  shift.length_s = 0.25;
  shift.tracks.push_back({0, AnimatedProperty::translation, Interpolation::linear, {0.25f}, {7, 8, 9}});
  scene.animations = {bend, shift};
  return scene;
}

TEST_F(GlbWriter, LoaderReadsBackWhatMoves) {
  const Scene scene = moving_scene();
  write_glb(scene, folder / "moving.glb");
  const Scene read = load_gltf(folder / "moving.glb");
  const auto named = [&](const std::string& name) {
    for (size_t i = 0; i < read.nodes.size(); ++i)
      if (read.nodes[i].name == name) return i;
    return read.nodes.size();
  };
  for (const Node& node : scene.nodes) {
    const size_t i = named(node.name);
    ASSERT_LT(i, read.nodes.size()) << node.name;
    EXPECT_EQ(read.nodes[i].translation, node.translation);
    EXPECT_EQ(read.nodes[i].scale, node.scale);
    EXPECT_NEAR(glm::dot(read.nodes[i].rotation, node.rotation), 1.0, 1e-12);
    EXPECT_EQ(read.nodes[i].morph_weights, node.morph_weights);
  }
  EXPECT_EQ(read.nodes[named("tip")].parent, int(named("root")));
  ASSERT_EQ(read.skins.size(), 1u);
  EXPECT_EQ(read.skins[0].joints, (std::vector{uint32_t(named("root")), uint32_t(named("tip"))}));
  expect_same(read.skins[0].joint_from_bind[1], scene.skins[0].joint_from_bind[1]);

  bool strip_found = false, shape_found = false;
  for (const Instance& instance : read.instances) {
    const Mesh& mesh = read.meshes[instance.mesh];
    if (instance.skin == 0) {
      strip_found = true;
      ASSERT_EQ(mesh.positions.size(), 4u);
      const size_t third = 2 * mesh.influences;
      EXPECT_EQ(mesh.joints[third + 1], 1);
      EXPECT_EQ(mesh.weights[third], 0.25f);
      EXPECT_EQ(mesh.weights[third + 1], 0.75f);
    }
    if (!mesh.targets.empty()) {
      shape_found = true;
      EXPECT_EQ(instance.node, int(named("carrier")));
      EXPECT_EQ(mesh.targets[0].positions, scene.meshes[2].targets[0].positions);
      EXPECT_EQ(instance.morph_weights, std::vector<float>{0.25f});
    }
  }
  EXPECT_TRUE(strip_found && shape_found);
  for (const Camera& camera : read.cameras)
    EXPECT_EQ(camera.node, camera.name == "eye" ? int(named("carrier")) : int(named(camera.name)));
  for (const Light& light : read.lights)
    EXPECT_EQ(light.node, light.name == "spot" ? int(named("carrier")) : int(named(light.name)));

  ASSERT_EQ(read.animations.size(), 2u);
  for (size_t a = 0; a < 2; ++a) {
    const Animation &expected = scene.animations[a], &found = read.animations[a];
    EXPECT_EQ(found.name, expected.name);
    EXPECT_EQ(found.fault, "");
    EXPECT_DOUBLE_EQ(found.length_s, expected.length_s);
    ASSERT_EQ(found.tracks.size(), expected.tracks.size());
    for (size_t t = 0; t < expected.tracks.size(); ++t) {
      EXPECT_EQ(found.tracks[t].node, named(scene.nodes[expected.tracks[t].node].name));
      EXPECT_EQ(found.tracks[t].property, expected.tracks[t].property);
      EXPECT_EQ(found.tracks[t].interpolation, expected.tracks[t].interpolation);
      EXPECT_EQ(found.tracks[t].times_s, expected.tracks[t].times_s);
      EXPECT_EQ(found.tracks[t].values, expected.tracks[t].values);
    }
  }
}

TEST_F(GlbWriter, SameSceneGivesSameBytes) {
  const std::vector<uint8_t> bytes = to_glb(make_garden(1));
  EXPECT_EQ(bytes, to_glb(make_garden(1)));
  EXPECT_NE(bytes, to_glb(make_garden(2)));
  write_glb(make_garden(1), folder / "garden.glb");
  std::ifstream file{folder / "garden.glb", std::ios::binary};
  const std::vector<char> on_disk{std::istreambuf_iterator<char>{file}, {}};
  ASSERT_EQ(bytes.size(), on_disk.size());
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), on_disk.begin(),
                         [](uint8_t a, char b) { return a == static_cast<uint8_t>(b); }));
}

TEST_F(GlbWriter, ReplacesAnOlderFileAndLeavesNoTemporary) {
  std::ofstream{folder / "scene.glb"} << "old";
  write_glb(small_scene(), folder / "scene.glb");
  EXPECT_GT(fs::file_size(folder / "scene.glb"), 3u);
  EXPECT_EQ(std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}), 1);
}

TEST_F(GlbWriter, UnwritablePathIsOneSentenceThatNamesIt) {
  const fs::path absent = folder / "absent" / "scene.glb";
  try {
    write_glb(small_scene(), absent);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string{error.what()}, "cannot write '" + absent.string() + "': the folder '" +
                                             (folder / "absent").string() + "' does not exist");
  }
  fs::create_directories(folder / "folder.glb" / "inside");
  EXPECT_THROW(write_glb(small_scene(), folder / "folder.glb"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}), 1) << "a temporary file was left";
}

TEST_F(GlbWriter, FullDiskIsAnError) {
  const auto full = full_device(folder);
  if (!full) GTEST_SKIP() << "no full device";
  try {
    write_glb(small_scene(), *full);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("No space left on device"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_character_file(*full));
}

TEST_F(GlbWriter, RefusesWhatItDoesNotWrite) {
  Scene textured = small_scene();
  textured.textures.emplace_back();
  EXPECT_THROW(to_glb(textured), Error);
  Scene hollow = small_scene();
  hollow.meshes[0].indices.clear();
  EXPECT_THROW(to_glb(hollow), Error);
  Scene shared = moving_scene();
  shared.instances.push_back(shared.instances[3]);
  EXPECT_THROW(to_glb(shared), Error) << "two meshes that share morph weights";
  Scene endless = small_scene();
  endless.cameras[1].far_plane = std::numeric_limits<double>::infinity();
  EXPECT_THROW(to_glb(endless), Error);
}

}  // namespace
}  // namespace izb

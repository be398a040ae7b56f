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
    const Scene scene = procedural.make(1);
    const fs::path path = folder / (std::string{procedural.name} + ".glb");
    write_glb(scene, path);
    const Scene read = load_gltf(path);
    expect_same(scene, read);
    EXPECT_EQ(scene.triangle_count(), read.triangle_count());
    EXPECT_TRUE(read.ignored.empty());
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
  Scene endless = small_scene();
  endless.cameras[1].far_plane = std::numeric_limits<double>::infinity();
  EXPECT_THROW(to_glb(endless), Error);
}

}  // namespace
}  // namespace izb

// SPDX-License-Identifier: MIT
// The loader on files made by others: the folder that the environment variable IZB_SCENES names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf.h"
#include "scene/view.h"

namespace izb {
namespace {

/// A file and its triangles as placed; with a cause instead, it must be refused with that sentence.
struct Known {
  const char* file;
  size_t triangles;
  const char* cause = "";
};

const std::vector<Known> known_scenes = {
    {"sponza_dabrovic.glb", 66454},
    {"two_cylinder_engine.glb", 121496},
    {"ldraw_xwing.glb", 268852},
    {"morse_human_rig.glb", 7735},
    {"stk_tux_animated.glb", 4626},
    {"odd/alpha_mask_house.glb", 10497},
    {"odd/animated_morph_cube.glb", 12},
    {"odd/box_textured.glb", 12},
    {"odd/camera_light.glb", 14},
    {"odd/cameras.gltf", 2},
    {"odd/cornell_box.glb", 36},
    {"odd/cubes_light.glb", 36},
    {"odd/draco_heart.glb", 180},
    {"odd/fox_no_indices.glb", 576},
    {"odd/gpu_instancing_ext.glb", 12},
    {"odd/lights_punctual.glb", 12},
    {"odd/meshopt_pirate.glb", 5010},
    {"odd/morph_primitives.glb", 32},
    {"odd/morph_stress_test.glb", 2412},
    {"odd/prim_mode_00.glb", 0, "only points or lines"},
    {"odd/prim_mode_01.glb", 0, "only points or lines"},
    {"odd/prim_mode_02.glb", 0, "only points or lines"},
    {"odd/prim_mode_03.glb", 0, "only points or lines"},
    {"odd/prim_mode_04.glb", 2},
    {"odd/prim_mode_05.glb", 2},
    {"odd/prim_mode_06.glb", 2},
    {"odd/prim_mode_07.glb", 0, "only points or lines"},
    {"odd/prim_mode_08.glb", 0, "only points or lines"},
    {"odd/prim_mode_09.glb", 0, "only points or lines"},
    {"odd/prim_mode_10.glb", 0, "only points or lines"},
    {"odd/prim_mode_11.glb", 2},
    {"odd/prim_mode_12.glb", 2},
    {"odd/prim_mode_13.glb", 2},
    {"odd/prim_mode_14.glb", 2},
    {"odd/prim_mode_15.glb", 2},
    {"odd/rigged_simple.glb", 892},
    {"odd/simple_skin_embedded.gltf", 8},
    {"odd/sparse_accessor_embedded.gltf", 12},
    {"odd/texture_transform.glb", 24},
    {"odd/two_sided_plane.glb", 2},
    {"odd/invalid/all_indices_out_of_range.glb", 0, "index 65535 is out of range (24 vertices)"},
    {"odd/invalid/incorrect_vertex_arrays.glb", 0, "bufferViews[2] ends at byte 936"},
    {"odd/invalid/index_out_of_range.glb", 0, "index 255 is out of range (24 vertices)"},
    {"odd/invalid/infinite_positions.glb", 0, "the position of vertex 0 is not finite"},
    {"odd/invalid/missing_bin.gltf", 0, "BoxTextured0.bin' is missing"},
    {"odd/invalid/no_scene.gltf", 0, "scene is 0, but the file's number of scenes is 0"},
    {"odd/invalid/recursive_nodes.gltf", 0, "a cycle of nodes"},
    {"odd/invalid/scene_without_nodes.gltf", 0, "holds no triangle"},
    {"odd/invalid/wrong_types/badArray.gltf", 0, "meshes[0].primitives is not an array"},
    {"odd/invalid/wrong_types/badNumber.gltf", 0, "materials[0].normalTexture has no 'index'"},
    {"odd/invalid/wrong_types/badObject.gltf", 0, "materials[0].pbrMetallicRoughness is not an object"},
    {"odd/invalid/wrong_types/badString.gltf", 0, "scenes[0].name is not a string"},
    {"odd/invalid/wrong_types/badUint.gltf", 0, "baseColorTexture.index is not an index"},
};

class GltfScenes : public testing::Test {
 protected:
  std::filesystem::path scenes;

  void SetUp() override {
    const char* variable = std::getenv("IZB_SCENES");
    if (!variable) GTEST_SKIP() << "IZB_SCENES names no folder of scenes";
    scenes = variable;
  }
};

TEST_F(GltfScenes, TriangleCountsAndCauses) {
  for (const Known& known : known_scenes) {
    SCOPED_TRACE(known.file);
    if (!std::filesystem::exists(scenes / known.file)) continue;  // somebody's own folder
    try {
      const Scene scene = load_gltf(scenes / known.file);
      EXPECT_EQ(scene.triangle_count(), known.triangles);
      EXPECT_STREQ(known.cause, "") << "it should be refused";
      for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
      }
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(known.cause), std::string::npos) << e.what();
      EXPECT_STRNE(known.cause, "") << e.what();
    }
  }
}

TEST_F(GltfScenes, EveryOddFileIsInTheTable) {
  if (!std::filesystem::exists(scenes / "odd")) GTEST_SKIP() << "IZB_SCENES has no folder 'odd'";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes / "odd")) {
    const auto extension = entry.path().extension();
    if (extension != ".glb" && extension != ".gltf") continue;
    const std::string file = std::filesystem::relative(entry.path(), scenes).string();
    EXPECT_TRUE(std::any_of(known_scenes.begin(), known_scenes.end(), [&](const Known& known) {
      return known.file == file;
    })) << file;
  }
}

TEST_F(GltfScenes, MirroredPartsStayMirrored) {
  if (!std::filesystem::exists(scenes / "ldraw_xwing.glb")) GTEST_SKIP() << "there is no ldraw_xwing.glb";
  const Scene scene = load_gltf(scenes / "ldraw_xwing.glb");
  const auto mirrored = std::count_if(scene.instances.begin(), scene.instances.end(), [](const Instance& i) {
    return glm::determinant(glm::dmat3(i.world_from_object)) < 0.0;
  });
  EXPECT_GE(mirrored, 49);
}

TEST_F(GltfScenes, SkinnedFiguresStandUpright) {
  if (!std::filesystem::exists(scenes / "morse_human_rig.glb")) GTEST_SKIP() << "there is no morse_human_rig.glb";
  const Bounds bounds = world_bounds(load_gltf(scenes / "morse_human_rig.glb"));
  EXPECT_NEAR(bounds.min.x, -3.025, 0.01);
  EXPECT_NEAR(bounds.max.x, 10.2, 0.01);
  EXPECT_NEAR(bounds.min.y, -2.203, 0.01);
}

}  // namespace
}  // namespace izb

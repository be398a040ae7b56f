// SPDX-License-Identifier: MIT
// What a glTF file means, shown by small files that are written here.
#include "scene/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/epsilon.hpp>

#include "gltf_writer.h"
#include "scene/pose.h"
#include "scene/view.h"

namespace izb {
namespace {

using test::GltfWriter;
using test::json;
using test::one_triangle;
using test::write_file;

/// A red pixel and a blue one beside it.
constexpr const char* png_2x1 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/PX2MSQAAAABJRU5ErkJggg==";

bool says(const Scene& scene, const std::string& text) {
  for (const std::string& sentence : scene.ignored)
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

using Indices = std::vector<uint32_t>;
using Positions = std::vector<glm::vec3>;

class Gltf : public testing::Test {
 protected:
  test::TemporaryFolder folder;

  Scene load(const GltfWriter& gltf) { return load_gltf(write_file(folder / "scene.glb", gltf.glb())); }

  /// The indices that four vertices give in a mode, with or without an index accessor.
  Indices indices_of_mode(int mode, bool indexed) {
    GltfWriter gltf;
    json primitive = {{"mode", mode}};
    primitive["attributes"]["POSITION"] = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    if (indexed) primitive["indices"] = gltf.add_array(std::vector<uint8_t>{3, 2, 1, 0}, test::type_uint8, "SCALAR", 1);
    gltf.add_root({{"mesh", gltf.add_mesh(primitive)}});
    return load(gltf).meshes.at(0).indices;
  }
};

TEST_F(Gltf, OneTriangle) {
  const Scene scene = load(one_triangle());
  EXPECT_EQ(scene.name, "scene");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].indices, (Indices{0, 1, 2}));
  EXPECT_EQ(scene.meshes[0].positions, (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.meshes[0].material, 0u);
  EXPECT_TRUE(scene.ignored.empty());
}

TEST_F(Gltf, ModesKeepTheWinding) {
  EXPECT_EQ(indices_of_mode(4, false), (Indices{0, 1, 2}));
  EXPECT_EQ(indices_of_mode(5, false), (Indices{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(indices_of_mode(6, false), (Indices{1, 2, 0, 2, 3, 0}));
  EXPECT_EQ(indices_of_mode(4, true), (Indices{2, 1, 0}));  // vertex 0, which none uses, is not there
  EXPECT_EQ(indices_of_mode(5, true), (Indices{3, 2, 1, 2, 0, 1}));
  EXPECT_EQ(indices_of_mode(6, true), (Indices{2, 1, 3, 1, 0, 3}));
}

TEST_F(Gltf, IndexTypes) {
  GltfWriter gltf;
  const int positions = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (const int indices : {gltf.add_array(std::vector<uint8_t>{2, 1, 0}, test::type_uint8, "SCALAR", 1),
                            gltf.add_array(std::vector<uint16_t>{2, 1, 0}, test::type_uint16, "SCALAR", 1),
                            gltf.add_array(std::vector<uint32_t>{2, 1, 0}, test::type_uint32, "SCALAR", 1)})
    gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.meshes.size(), 3u);
  for (const Mesh& mesh : scene.meshes) EXPECT_EQ(mesh.indices, (Indices{2, 1, 0}));
}

TEST_F(Gltf, IncompleteAndDegenerateTriangles) {
  GltfWriter gltf;
  json primitive;
  primitive["attributes"]["POSITION"] = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  primitive["indices"] = gltf.add_array(std::vector<uint16_t>{0, 1, 2, 1, 1, 1, 0, 2}, test::type_uint16, "SCALAR", 1);
  gltf.add_root({{"mesh", gltf.add_mesh(primitive)}});
  const Scene scene = load(gltf);
  EXPECT_EQ(scene.meshes.at(0).indices, (Indices{0, 1, 2, 1, 1, 1}));
  EXPECT_TRUE(says(scene, "beyond the last whole triangle of their primitive: 2"));
}

TEST_F(Gltf, InterleavedAndNormalized) {
  struct Vertex {
    int16_t position[3], unused;
    int8_t normal[3], unused_too;
    uint16_t uv[2];
  };
  const std::vector<Vertex> vertices = {{{32767, -32768, 0}, 0, {0, 0, 127}, 0, {0, 65535}},
                                        {{0, 32767, 0}, 0, {0, 127, 0}, 0, {65535, 0}},
                                        {{0, 0, -32767}, 0, {-127, 0, 0}, 0, {0, 0}}};
  GltfWriter gltf = one_triangle();
  const int view = gltf.add_view(test::bytes_of(vertices), sizeof(Vertex));
  const auto add = [&](int type, const char* shape, size_t offset) {
    const int accessor = gltf.add_accessor(view, type, shape, 3);
    gltf.root["accessors"][static_cast<size_t>(accessor)]["byteOffset"] = offset;
    gltf.root["accessors"][static_cast<size_t>(accessor)]["normalized"] = true;
    return accessor;
  };
  json& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["POSITION"] = add(test::type_int16, "VEC3", 0);
  attributes["NORMAL"] = add(test::type_int8, "VEC3", 8);
  attributes["TEXCOORD_1"] = add(test::type_uint16, "VEC2", 12);
  gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}};
  gltf.root["textures"] = {{{"source", 0}}};
  gltf.root["images"] = {{{"uri", std::string("data:image/png;base64,") + png_2x1}}};
  gltf.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Mesh mesh = load(gltf).meshes.at(0);
  EXPECT_EQ(mesh.positions, (Positions{{1, -1, 0}, {0, 1, 0}, {0, 0, -1}}));
  EXPECT_EQ(mesh.normals, (Positions{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}));
  EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 1}, {1, 0}, {0, 0}}));
}

TEST_F(Gltf, QuantizedButNotNormalized) {
  GltfWriter gltf = one_triangle();
  const std::vector<uint8_t> bytes = {0, 0, 0, 0, 200, 0, 0, 0, 0, 100, 0, 0};
  const int accessor = gltf.add_accessor(gltf.add_view(test::bytes_of(bytes), 4), test::type_uint8, "VEC3", 3);
  gltf.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
  EXPECT_EQ(load(gltf).meshes.at(0).positions, (Positions{{0, 0, 0}, {200, 0, 0}, {0, 100, 0}}));
}

TEST_F(Gltf, SparseOverViewAndOverZeros) {
  for (const bool with_view : {true, false}) {
    GltfWriter gltf = one_triangle();
    const int places = gltf.add_view(test::bytes_of(std::vector<uint16_t>{2}));
    const int values = gltf.add_view(test::bytes_of(std::vector<float>{5, 6, 7}));
    json& accessor = gltf.root["accessors"][0];
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", places}, {"componentType", test::type_uint16}}},
                          {"values", {{"bufferView", values}}}};
    if (!with_view) accessor.erase("bufferView");
    const float x = with_view ? 1.0f : 0.0f;
    EXPECT_EQ(load(gltf).meshes.at(0).positions, (Positions{{0, 0, 0}, {x, 0, 0}, {5, 6, 7}}));
  }
}

TEST_F(Gltf, HierarchyInDoublePrecisionWithNegativeScale) {
  GltfWriter gltf = one_triangle();
  gltf.root["nodes"][0]["translation"] = {0.25, 0, 0};
  gltf.root["nodes"][0]["scale"] = {-2, 1, 1};
  const double h = std::sqrt(0.5);
  const int turned = gltf.append("nodes", {{"rotation", {0, 0, h, h}}, {"children", {0}}});
  const int far = gltf.append(
      "nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 16777216, 0, 0, 1}}, {"children", {turned}}});
  gltf.root["scenes"][0]["nodes"] = {far};
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.instances.size(), 1u);
  const glm::dmat4& m = scene.instances[0].world_from_object;
  const glm::dmat4 expected(0, -2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 16777216, 0.25, 0, 1);
  for (int c = 0; c < 4; ++c) EXPECT_TRUE(glm::all(glm::epsilonEqual(m[c], expected[c], 1e-12))) << "column " << c;
  EXPECT_LT(glm::determinant(glm::dmat3(m)), 0.0);
  EXPECT_NEAR(m[3].y, 0.25, 1e-12);
}

TEST_F(Gltf, AMeshOfSeveralNodesIsLoadedOnce) {
  GltfWriter gltf = one_triangle();
  gltf.add_root({{"mesh", 0}, {"translation", {0, 0, 3}}});
  const Scene scene = load(gltf);
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(world_bounds(scene).max, glm::dvec3(1, 1, 3));
}

TEST_F(Gltf, WhichSceneIsShown) {
  GltfWriter gltf = one_triangle();
  gltf.root["scenes"].push_back({{"nodes", {gltf.append("nodes", {{"mesh", 0}}), 0}}});
  EXPECT_EQ(load(gltf).instances.size(), 1u);
  gltf.root["scene"] = 1;
  EXPECT_EQ(load(gltf).instances.size(), 2u);
  gltf.root.erase("scene");
  EXPECT_EQ(load(gltf).instances.size(), 1u);
  gltf.root.erase("scenes");
  EXPECT_EQ(load(gltf).instances.size(), 2u);
}

TEST_F(Gltf, SharedVerticesAreSplit) {
  GltfWriter gltf;
  std::vector<float> xyz(300);
  for (size_t i = 0; i < xyz.size(); ++i) xyz[i] = static_cast<float>(i);
  json primitive;
  primitive["attributes"]["POSITION"] = gltf.add_positions(xyz);
  primitive["indices"] = gltf.add_array(std::vector<uint16_t>{90, 7, 90}, test::type_uint16, "SCALAR", 1);
  gltf.add_root({{"mesh", gltf.add_mesh(primitive)}});
  const Mesh mesh = load(gltf).meshes.at(0);
  EXPECT_EQ(mesh.indices, (Indices{0, 1, 0}));
  EXPECT_EQ(mesh.positions, (Positions{{270, 271, 272}, {21, 22, 23}}));
}

TEST_F(Gltf, NormalsHaveUnitLength) {
  GltfWriter gltf = one_triangle();
  gltf.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = gltf.add_positions({0, 0, 4, 0, 0, 0, 0, NAN, 0});
  const Scene scene = load(gltf);
  for (const glm::vec3& n : scene.meshes.at(0).normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  EXPECT_TRUE(says(scene, "normals without a direction: 2"));
}

TEST_F(Gltf, Material) {
  GltfWriter gltf = one_triangle();
  gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.root["materials"] = {
      {{"name", "leaf"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"doubleSided", true},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.75}}}},
      {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.materials.size(), 2u);
  const Material& leaf = scene.materials[0];
  EXPECT_EQ(leaf.name, "leaf");
  EXPECT_EQ(leaf.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
  EXPECT_EQ(leaf.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(leaf.alpha_cutoff, 0.25f);
  EXPECT_TRUE(leaf.double_sided);
  EXPECT_EQ(leaf.metallic, 0.0f);
  EXPECT_EQ(leaf.roughness, 0.75f);
  EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::blend);
  EXPECT_FALSE(scene.materials[1].double_sided);
  EXPECT_FALSE(says(scene, "alpha mask"));  // it applies
  EXPECT_TRUE(says(scene, "alpha blending: 1, they cast and receive as opaque"));
  EXPECT_TRUE(says(scene, "unlit materials: 1"));
}

class GltfTexture : public Gltf {
 protected:
  GltfWriter gltf = one_triangle();
  GltfTexture() {
    gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
    json& info = gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["index"] = 0;
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    gltf.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
    gltf.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    gltf.root["images"] = {{{"uri", std::string("data:image/png;base64,") + png_2x1}}};
  }
};

TEST_F(GltfTexture, PixelsSamplerAndTransform) {
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.textures.size(), 1u);
  const Texture& texture = scene.textures[0];
  EXPECT_EQ(texture.width_px, 2);
  EXPECT_EQ(texture.height_px, 1);
  EXPECT_EQ(texture.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));
  EXPECT_EQ(texture.wrap_u, Wrap::clamp_to_edge);
  EXPECT_EQ(texture.wrap_v, Wrap::mirrored_repeat);
  EXPECT_TRUE(texture.nearest);
  EXPECT_EQ(scene.materials.at(0).base_color_texture, 0);
  // The specification's example: the lower left quadrant of the image.
  const glm::mat3& m = scene.materials[0].uv_transform;
  const glm::vec3 origin = m * glm::vec3(0, 0, 1), corner = m * glm::vec3(1, 1, 1);
  EXPECT_TRUE(glm::all(glm::epsilonEqual(origin, glm::vec3(0, 1, 1), 1e-6f)));
  EXPECT_TRUE(glm::all(glm::epsilonEqual(corner, glm::vec3(0.5f, 0.5f, 1), 1e-6f)));
  const glm::vec3 right = m * glm::vec3(1, 0, 1);
  EXPECT_TRUE(glm::all(glm::epsilonEqual(right, glm::vec3(0, 0.5f, 1), 1e-6f)));
}

TEST_F(GltfTexture, TwoSamplersShareOneImage) {
  gltf.root["textures"].push_back({{"source", 0}});
  gltf.root["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[0].rgba, scene.textures[1].rgba);
  EXPECT_EQ(scene.textures[1].wrap_u, Wrap::repeat);
  EXPECT_FALSE(scene.textures[1].nearest);
}

TEST_F(GltfTexture, AbsentOrBrokenImageIsAWarning) {
  write_file(folder / "broken.png", "no picture");
  for (const auto& [name, reason] :
       {std::pair("absent.png", "is missing"), std::pair("broken.png", "cannot be decoded")}) {
    gltf.root["images"] = {{{"uri", name}}};
    testing::internal::CaptureStderr();
    const Scene scene = load(gltf);
    const std::string warning = testing::internal::GetCapturedStderr();
    EXPECT_NE(warning.find(name), std::string::npos) << warning;
    EXPECT_NE(warning.find(reason), std::string::npos) << warning;
    EXPECT_EQ(scene.materials.at(0).base_color_texture, -1);
    EXPECT_TRUE(scene.textures.empty());
  }
}

TEST_F(Gltf, ExternalBufferWithEscapedNameMayBeLonger) {
  GltfWriter gltf = one_triangle();
  gltf.root["buffers"] = {{{"byteLength", gltf.buffer.size()}, {"uri", "my%20data.bin"}}};
  write_file(folder / "my data.bin", gltf.buffer + "padding");
  const Scene scene = load_gltf(write_file(folder / "scene.gltf", gltf.root.dump()));
  EXPECT_EQ(scene.triangle_count(), 1u);
}

TEST_F(Gltf, Cameras) {
  GltfWriter gltf = one_triangle();
  gltf.root["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"zfar", 50}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 100}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", -1}, {"znear", 0.1}}}}};
  gltf.add_root({{"name", "eye"}, {"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {2, -3, 4}}});
  for (int i = 1; i < 4; ++i) gltf.add_root({{"camera", i}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.cameras.size(), 3u);
  const Camera& eye = scene.cameras[0];
  EXPECT_EQ(eye.name, "eye");
  EXPECT_TRUE(std::isinf(eye.far_plane));
  EXPECT_EQ(eye.yfov_rad, 0.5);
  EXPECT_EQ(eye.near_plane, 0.1);
  const glm::dmat4 expected(-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 1, 2, 3,
                            1);  // up is down, as the node says
  EXPECT_EQ(eye.world_from_view, expected);
  EXPECT_EQ(scene.cameras[1].far_plane, 50.0);
  EXPECT_EQ(scene.cameras[1].name, "camera 1");
  EXPECT_TRUE(scene.cameras[2].orthographic);
  EXPECT_EQ(scene.cameras[2].ymag, 3.0);
  EXPECT_TRUE(says(scene, "camera 'camera 3' is left out"));
}

TEST_F(Gltf, Lights) {
  GltfWriter gltf = one_triangle();
  gltf.root["extensionsRequired"] = {"KHR_lights_punctual"};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0.25}}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}, {"range", 9}},
      {{"type", "point"}, {"name", "bulb"}},
      {{"type", "area"}}};
  const auto add = [&](int light, json node) {
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    gltf.add_root(node);
  };
  const double h = std::sqrt(0.5);
  add(0, {{"name", "sun"}, {"rotation", {-h, 0, 0, h}}, {"scale", {5, 5, 5}}});  // -z turned to -y
  add(1, {{"translation", {1, 2, 3}}});
  add(2, json::object());
  add(3, {{"name", "panel"}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.lights.size(), 3u);
  const Light &sun_light = scene.lights[0], &spot = scene.lights[1], &point = scene.lights[2];
  EXPECT_EQ(sun_light.name, "sun");
  EXPECT_EQ(sun_light.type, LightType::directional);
  EXPECT_EQ(sun_light.intensity, 3.0f);
  EXPECT_EQ(sun_light.color, glm::vec3(1.0f, 0.5f, 0.25f));
  EXPECT_NEAR(glm::distance(sun_light.direction_ws, glm::dvec3(0, -1, 0)), 0.0, 1e-12);
  EXPECT_EQ(spot.type, LightType::spot);
  EXPECT_EQ(spot.name, "light 1");
  EXPECT_EQ(spot.position_ws, glm::dvec3(1, 2, 3));
  EXPECT_EQ(spot.direction_ws, glm::dvec3(0, 0, -1));
  EXPECT_EQ(spot.inner_cone_rad, 0.1);
  EXPECT_EQ(spot.outer_cone_rad, 0.5);
  EXPECT_EQ(point.type, LightType::point);
  EXPECT_EQ(point.name, "bulb");
  EXPECT_TRUE(says(scene, "light 'panel' of type 'area' is left out"));
  EXPECT_EQ(spot.range, 9.0);
  EXPECT_EQ(point.range, 0.0);
}

TEST_F(Gltf, ASkinPlacesItsMesh) {
  GltfWriter gltf = one_triangle();
  json& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = gltf.add_positions({1, 0, 0, 1, 0, 0, 1, 0, 0});
  attributes["JOINTS_0"] =
      gltf.add_array(std::vector<uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, test::type_uint8, "VEC4", 4);
  // The third vertex hangs between both joints.
  attributes["WEIGHTS_0"] =
      gltf.add_array(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0}, test::type_float, "VEC4", 4);
  std::vector<float> inverse_binds(32, 0.0f);
  for (const size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u}) inverse_binds[i] = 1.0f;
  inverse_binds[13] = -2.0f;  // joint 0 was bound at y = 2
  const int matrices = gltf.add_array(inverse_binds, test::type_float, "MAT4", 16);
  const double h = std::sqrt(0.5);
  const int root = gltf.add_root({{"translation", {0, 5, 0}}});
  const int turned = gltf.append("nodes", {{"rotation", {0, 0, h, h}}});  // x to y
  gltf.root["nodes"][static_cast<size_t>(root)]["children"] = {turned};
  gltf.root["skins"] = {{{"joints", {root, turned}}, {"inverseBindMatrices", matrices}}};
  gltf.root["nodes"][0]["skin"] = 0;
  gltf.root["nodes"][0]["translation"] = {100, 100, 100};  // without effect
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.instances.size(), 1u);
  const std::vector<glm::dvec3> world = posed_positions_ws(scene, scene.instances[0]);
  const Positions expected = {{0, 3, 0}, {0, 6, 0}, {-0.5f, 4.5f, 0}};
  for (size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(world[i], glm::dvec3(expected[i])), 1e-5) << i;
  EXPECT_TRUE(says(scene, "skinned primitives: 1, standing in bind pose"));
}

TEST_F(Gltf, UnusedVerticesGoWithAllThatTheyHave) {
  GltfWriter gltf;
  const auto rising = [&](float step) {  // five vectors (n, n + step, 0)
    std::vector<float> all;
    for (int n = 0; n < 5; ++n) all.insert(all.end(), {float(n), float(n) + step, 0.0f});
    return gltf.add_array(all, test::type_float, "VEC3", 3);
  };
  json attributes = {{"POSITION", rising(1)}, {"NORMAL", rising(2)}};
  attributes["JOINTS_0"] = gltf.add_array(
      std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0}, test::type_uint8, "VEC4", 4);
  std::vector<float> weights;
  for (int n = 0; n < 5; ++n) weights.insert(weights.end(), {1.0f, 0.0f, 0.0f, 0.0f});
  attributes["WEIGHTS_0"] = gltf.add_array(weights, test::type_float, "VEC4", 4);
  const json targets = {{{"POSITION", rising(3)}, {"NORMAL", rising(4)}}};
  // Vertex 0 lies before the first that is used, vertex 3 between.
  const int indices = gltf.add_array(std::vector<uint16_t>{1, 4, 2}, test::type_uint16, "SCALAR", 1);
  gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", attributes}, {"indices", indices}, {"targets", targets}})}});
  const Scene scene = load(gltf);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
  ASSERT_EQ(mesh.positions.size(), 3u);
  ASSERT_EQ(mesh.influences, 1u);
  for (size_t i = 0; i < 3; ++i) {
    const float n[] = {1, 4, 2};
    EXPECT_EQ(mesh.positions[i], glm::vec3(n[i], n[i] + 1, 0));
    EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(glm::vec3(n[i], n[i] + 2, 0))), 1e-6f);
    EXPECT_EQ(mesh.targets[0].positions[i], glm::vec3(n[i], n[i] + 3, 0));
    EXPECT_EQ(mesh.targets[0].normals[i], glm::vec3(n[i], n[i] + 4, 0));
    EXPECT_EQ(mesh.joints[i], uint16_t(n[i]));
    EXPECT_EQ(mesh.weights[i], 1.0f);
  }
}

TEST_F(Gltf, MorphWeightsOfMeshAndNode) {
  GltfWriter gltf = one_triangle();
  json& mesh = gltf.root["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", gltf.add_positions({0, 0, 4, 0, 0, 4, 0, 0, 4})}}};
  mesh["weights"] = {0.5};
  gltf.add_root({{"mesh", 0}, {"weights", {0.25}}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);  // both are placements of one
  EXPECT_EQ(posed_positions_ws(scene, scene.instances[0])[0].z, 2.0);
  EXPECT_EQ(posed_positions_ws(scene, scene.instances[1])[0].z, 1.0);
  EXPECT_TRUE(says(scene, "morph targets: 2, standing still"));
}

TEST_F(Gltf, WhatIsNotShownIsSaid) {
  GltfWriter gltf = one_triangle();
  gltf.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "VENDOR_thing", "KHR_texture_transform"};
  gltf.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
  for (const int mode : {0, 1, 2, 3})
    gltf.root["meshes"][0]["primitives"].push_back({{"mode", mode}, {"attributes", {{"POSITION", 0}}}});
  gltf.root["meshes"][0]["primitives"].push_back({{"attributes", {{"COLOR_0", 0}}}});
  const Scene scene = load(gltf);
  EXPECT_EQ(scene.triangle_count(), 1u);
  for (const char* text : {"extension EXT_mesh_gpu_instancing is ignored", "extension VENDOR_thing is ignored",
                           "animations: 1", "made of points: 1", "made of lines: 3", "without positions: 1"})
    EXPECT_TRUE(says(scene, text)) << text;
  EXPECT_FALSE(says(scene, "KHR_texture_transform"));
}

}  // namespace
}  // namespace izb

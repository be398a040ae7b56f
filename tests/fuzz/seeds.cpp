// SPDX-License-Identifier: MIT
// Small valid files for the fuzzer to begin with: fuzz_seeds FOLDER.
#include <cstdio>

#include "cpu/compressed_files.h"

namespace {

using namespace izb::test;

GltfWriter strip_with_attributes() {
  GltfWriter gltf;
  const int positions = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const int normals =
      gltf.add_array(std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127}, type_int8, "VEC3", 3);
  const int uvs = gltf.add_array(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, type_float, "VEC2", 2);
  gltf.root["accessors"][static_cast<size_t>(normals)]["normalized"] = true;
  // A red pixel.
  gltf.root["images"] = {
      {{"uri",
        "data:image/"
        "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg="
        "="}}};
  gltf.root["textures"] = {{{"source", 0}}};
  gltf.root["materials"] = {
      {{"alphaMode", "MASK"},
       {"alphaCutoff", 0.4},
       {"doubleSided", true},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.2, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
  gltf.add_root(
      {{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                               {"mode", 5},
                               {"material", 0}})},
       {"rotation", {0, 0.7071, 0, 0.7071}},
       {"scale", {1, 2, 3}}});
  return gltf;
}

GltfWriter camera_and_lights() {
  GltfWriter gltf = one_triangle();
  gltf.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  gltf.append("cameras",
              {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}});
  gltf.add_root({{"camera", 0}, {"translation", {0, 8, 8}}});
  gltf.add_root({{"camera", 1}});
  gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}},
                                                              {{"type", "point"}, {"range", 5}},
                                                              {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
  for (int i = 0; i < 3; ++i) {
    json node = {{"translation", {0, 3, i}}};
    node["extensions"]["KHR_lights_punctual"]["light"] = i;
    gltf.add_root(node);
  }
  return gltf;
}

GltfWriter skinned_and_morphed() {
  GltfWriter gltf = one_triangle();
  json& primitive = gltf.root["meshes"][0]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] = gltf.add_array(std::vector<uint8_t>(12, 0), type_uint8, "VEC4", 4);
  primitive["attributes"]["WEIGHTS_0"] =
      gltf.add_array(std::vector<float>{1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0}, type_float, "VEC4", 4);
  const json target = {{"POSITION", gltf.add_positions({0, 0, 1, 0, 0, 1, 0, 0, 1})}};
  primitive["targets"] = {target, target};
  gltf.root["meshes"][0]["weights"] = {0.5, 0.25};
  const int binds =
      gltf.add_array(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, type_float, "MAT4", 16);
  const int joint = gltf.add_root({{"translation", {0, 1, 0}}});
  gltf.root["skins"] = {{{"joints", {joint}}, {"inverseBindMatrices", binds}}};
  gltf.root["nodes"][0]["skin"] = 0;
  // Sparse positions on top.
  json& accessor = gltf.root["accessors"][0];
  const int places = gltf.add_view(bytes_of(std::vector<uint16_t>{1}));
  const int values = gltf.add_view(bytes_of(std::vector<float>{2, 0, 0}));
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", places}, {"componentType", type_uint16}}},
                        {"values", {{"bufferView", values}}}};
  return gltf;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = words[1];
  std::filesystem::create_directories(folder);
  write_file(folder / "triangle.glb", one_triangle().glb());
  write_file(folder / "strip.glb", strip_with_attributes().glb());
  write_file(folder / "lights.glb", camera_and_lights().glb());
  write_file(folder / "skin.glb", skinned_and_morphed().glb());
#ifdef IZB_HAVE_MESHOPT
  write_file(folder / "meshopt.glb", meshopt_file(Bumps(3)).glb());
#endif
#ifdef IZB_HAVE_DRACO
  write_file(folder / "draco.glb", draco_file(Bumps(3)).glb());
#endif
}

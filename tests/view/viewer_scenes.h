// SPDX-License-Identifier: MIT
// Scenes for the viewer: small, so that a software renderer is quick, with edges of shadows all over the picture.
#pragma once
#include "cli/small_scenes.h"

namespace izb::test {

/// roof_over_floor() with posts around the roof, a second camera "low" and a second light, the lamp "bulb".
inline GltfWriter posts_on_floor() {
  GltfWriter gltf = roof_over_floor();
  const auto material = [&](double r, double g, double b) {
    return gltf.append("materials",
                       {{"doubleSided", true}, {"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}}}});
  };
  const int colours[] = {material(0.8, 0.3, 0.2), material(0.2, 0.6, 0.3), material(0.3, 0.4, 0.8)};
  const int positions = gltf.add_positions({-0.1f, 0, 0, 0.1f, 0, 0, 0.1f, 1.2f, 0.3f, -0.1f, 1.2f, 0.3f});
  const int indices = gltf.add_array(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, type_uint16, "SCALAR", 1);
  for (int i = 0; i < 81; ++i) {
    const int x = i % 9 - 4, z = i / 9 - 4;
    const int mesh =
        gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", colours[i % 3]}});
    gltf.add_root({{"mesh", mesh}, {"translation", {x, 0, z}}});
  }
  gltf.append("cameras", {{"name", "low"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  gltf.add_root({{"camera", 1}, {"translation", {0, 1.5, 6}}});
  auto& lights = gltf.root["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"name", "bulb"}, {"type", "point"}, {"intensity", 30}});
  json bulb = {{"translation", {1.5, 3, 1.5}}};
  bulb["extensions"]["KHR_lights_punctual"]["light"] = 1;
  gltf.add_root(bulb);
  return gltf;
}

/// The same; its roof slides to and fro within two seconds.
inline GltfWriter sliding_roof() {
  GltfWriter gltf = posts_on_floor();
  const int times = gltf.add_array(std::vector<float>{0, 1, 2}, type_float, "SCALAR", 1);
  const int places = gltf.add_array(std::vector<float>{-2, 0, 0, 2, 0, 0, -2, 0, 0}, type_float, "VEC3", 3);
  gltf.append("animations", {{"name", "slide"},
                             {"samplers", {{{"input", times}, {"output", places}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  return gltf;
}

}  // namespace izb::test

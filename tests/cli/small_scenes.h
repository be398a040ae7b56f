// SPDX-License-Identifier: MIT
// Scenes of a few triangles for the command line's tests.
#pragma once
#include "cpu/gltf_writer.h"

namespace izb::test {

/// A floor of 10 x 10 at y = 0, a 2 x 2 roof over its middle at y = 1, a camera "above" that sees all of it,
/// and the sun "noon" straight down.
inline GltfWriter roof_over_floor() {
  GltfWriter gltf;
  const auto quad = [&](float half, float y) {
    const int positions = gltf.add_positions({-half, y, -half, -half, y, half, half, y, half, half, y, -half});
    const int indices = gltf.add_array(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, type_uint16, "SCALAR", 1);
    gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  };
  quad(5.0f, 0.0f);
  quad(1.0f, 1.0f);
  gltf.append("cameras",
              {{"name", "above"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  // Looks down by 45 degrees from (0, 8, 8).
  gltf.add_root({{"camera", 0}, {"translation", {0, 8, 8}}, {"rotation", {-0.3826834324, 0, 0, 0.9238795325}}});
  gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"name", "noon"}, {"type", "directional"}}};
  // Lights shine along -z: turned down by 90 degrees.
  json sun = {{"rotation", {-0.7071067812, 0, 0, 0.7071067812}}};
  sun["extensions"]["KHR_lights_punctual"]["light"] = 0;
  gltf.add_root(sun);
  return gltf;
}

}  // namespace izb::test

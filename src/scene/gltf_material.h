// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include "scene/scene.h"

namespace izb {

/// Fills `scene.materials` (one a glTF material, same order) and `scene.textures` (those that base colours
/// read), and says in `scene.ignored` what of them is not shown. Takes the pixels out of the model's images.
void load_materials(tinygltf::Model& model, Scene& scene);

/// The TEXCOORD set that the material's base colour reads; -1 if it has no texture.
int base_color_uv_set(const tinygltf::Model& model, int material);

}  // namespace izb

// SPDX-License-Identifier: MIT
// The procedural scenes, one file each. All have metres, y up, a fixed camera "main", an animated one "path" and a
// light.
#pragma once
#include "scene/procedural/builder.h"

namespace izb::procedural {

void build_villa(Builder& b);
void build_town(Builder& b);
void build_terrain(Builder& b);
void build_hairball(Builder& b);
void build_tentacles(Builder& b);
void build_plane(Builder& b);
void build_powerplant(Builder& b);
void build_furball(Builder& b);
void build_character(Builder& b);
void build_grass(Builder& b);

}  // namespace izb::procedural

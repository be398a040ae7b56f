// SPDX-License-Identifier: MIT
// Scenes that are made by code: the same seed gives the same scene on every machine.
#pragma once
#include <cstdint>
#include <span>

#include "scene/scene.h"

namespace izb {

/// A walled garden at sunset, made to show what alias-free hard shadows are for: wires, spokes, grass,
/// lattices, a curved body, sharp contacts and long grazing shadows. World y up, metres, paving at y = 0; 100
/// to 300 thousand triangles placed. Cameras "main", "wires", "grass", "contact"; one directional light
/// "sunset".
Scene make_garden(uint32_t seed);

/// One entry of the table of procedural scenes.
struct Procedural {
  const char* name;
  const char* help;  ///< one line
  Scene (*make)(uint32_t seed);
};

/// Every procedural scene there is.
std::span<const Procedural> procedurals();

}  // namespace izb

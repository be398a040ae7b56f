// SPDX-License-Identifier: MIT
#include "scene/procedural.h"

#include <array>

#include "scene/procedural/fit.h"
#include "scene/procedural/scenes.h"

namespace izb {
namespace {

using namespace procedural;

/// Each scene's own function fits itself, so that the table stays plain data.
template <void (*build)(Builder&)>
Scene fit(const char* name, uint32_t seed, size_t triangles, size_t default_triangles) {
  return fitted(name, build, seed, triangles, default_triangles);
}

Scene garden(const char*, uint32_t seed, size_t, size_t) {
  return make_garden(seed);
}

constexpr std::array table{
    Procedural{"garden", "a walled garden at sunset: wires, spokes, grass, lattices, an urn, long grazing shadows",
               278'000, false, garden},
    Procedural{"villa", "a house by a pool: columns, balusters, louvres and furnished rooms", 89'000, true,
               fit<build_villa>},
    Procedural{"town", "a walled town under its citadel: crenels, gables, windows, narrow streets", 613'000, true,
               fit<build_town>},
    Procedural{"terrain", "mountains cut by water under a low sun, woods in the valleys", 1'500'000, true,
               fit<build_terrain>},
    Procedural{"hairball", "a ball of long curled threads, after Laine and Karras", 2'900'000, true,
               fit<build_hairball>},
    Procedural{"furball", "4000 hairs of 12 segments on a ball before a wall, after Lefohn et al. 2007", 284'000, true,
               fit<build_furball>},
    Procedural{"grass", "a meadow seen from low down: blades, flowers, stones, a fence", 1'000'000, true,
               fit<build_grass>},
    Procedural{"powerplant", "a coal power plant: steel frame, pipes, stairs and grating", 12'300'000, true,
               fit<build_powerplant>},
    Procedural{"tentacles", "sea anemones whose arms writhe: thin, curled, skinned", 3'800'000, true,
               fit<build_tentacles>},
    Procedural{"plane", "a racing airplane after the GeeBee: sheets, slivers, rivets, fins", 11'700'000, true,
               fit<build_plane>},
    Procedural{"character", "a man who waves in a room: skinned, lit by one lamp", 120'000, true, fit<build_character>},
};

}  // namespace

Scene Procedural::make(uint32_t seed, size_t wanted) const {
  return make_sized(name, seed, wanted == 0 ? triangles : wanted, triangles);
}

std::span<const Procedural> procedurals() {
  return table;
}

}  // namespace izb

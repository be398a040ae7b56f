// SPDX-License-Identifier: MIT
#include "scene/procedural.h"

#include <array>

namespace izb {

std::span<const Procedural> procedurals() {
  static constexpr std::array table{
      Procedural{"garden", "a walled garden at sunset: wires, spokes, grass, lattices, an urn, long grazing shadows",
                 make_garden},
  };
  return table;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// Views of single stages: a registry of pictures over a Snapshot. No GL.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "image/image.h"
#include "view/snapshot.h"

namespace izb {

/// What of a Snapshot may be absent, as flags.
struct Need {
  enum : unsigned {
    albedo = 1u << 0,
    shading_normal = 1u << 1,
    micro_quads = 1u << 2,  ///< absent at one sample a pixel
    mask = 1u << 3,
    truth = 1u << 4,
    list_length = 1u << 5,
    tests = 1u << 6,
    fragments = 1u << 7,  ///< with `built`, which has the grid's size
    windows = 1u << 8,
    built = 1u << 9,
    furthest = 1u << 10,  ///< of `built`; absent without z-cull
    left = 1u << 11,
  };
};

struct LookPicture {
  Image8 picture;
  std::string low, high;  ///< ends of the colour scale (heat_color) with units; empty: no scale
};

struct Look {
  const char* name;   ///< as the command line or a state file names it
  const char* stage;  ///< a word of frame/spine.h
  const char* help;   ///< one line for whoever sees it for the first time
  unsigned needs;     ///< flags of Need
  /// A picture of one layer of the light-space grid, its last row on top: texel (x, y) is pixel (x, grid - 1 - y).
  bool of_grid;
  LookPicture (*draw)(const Snapshot&, int layer);  ///< by paint(), which checks first
};

/// In the order of the stages.
std::span<const Look> looks();

/// The look of that name, or nullptr.
const Look* find_look(std::string_view name);

/// Flags of Need: what there is.
unsigned available(const Snapshot& snapshot);

/// `layer` counts for a look of the grid only. Throws std::logic_error if something that the look needs is missing, or
/// there is no such layer.
LookPicture paint(const Look& look, const Snapshot& snapshot, int layer = 0);

}  // namespace izb

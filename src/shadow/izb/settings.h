// SPDX-License-Identifier: MIT
// The options of the technique `izb`.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "base/options.h"
#include "frame/samples.h"
#include "gpu/glsl_front_end.h"
#include "shared/sweep.h"

namespace izb {

struct IzbSettings {
  static constexpr int by_size = -1;  ///< of pair_capacity

  SampleOptions sampling;
  std::string coverage = "lut", lut = "64", insertion = "approximate", cascade_pass = "single", raster = "gs",
              alpha = "exact";
  int grid = 2048, nodes = 8, cascades = 1, compute_texels = 1 << 28, compute_rounds = 64;
  double dilation_texels = 1.0, grid_density = 4.0;
  bool zcull = true, zcull_pyramid = true, nl_cull = true, occluders = true;
  bool removal = true, unchanged_skip = true, pipelining = false;
  int pair_capacity = by_size;
  /// No option, for tests: the order of insertion is n * stride modulo the number of pixels, to which the stride is
  /// coprime. Nothing but the order within the lists may depend on it.
  int insertion_stride = 1;
  /// No options, for tests: room in the list of --raster compute.
  uint32_t rows_room = shared::rows_room, tiles_room = shared::tiles_room;
  /// No option: how the scene's buffers are bound.
  gpu::Defines geometry;

  /// Declares every option, bound to this object.
  OptionSet options();
  /// Sets what the preset is about and leaves the rest. Throws izb::UsageError for an unknown name.
  void apply(const std::string& preset);
  static std::vector<std::string> preset_names();

  bool many_samples() const { return sampling.spp != "1"; }
  bool table() const { return many_samples() && coverage == "lut"; }
  bool pool() const { return many_samples() && insertion == "exact"; }
  bool alpha_masks() const { return alpha != "off"; }
  bool hardware() const { return raster == "hw"; }
  bool compute() const { return raster == "compute"; }
  bool pyramid() const { return zcull && zcull_pyramid; }
  int table_side() const { return std::stoi(lut); }
  /// Slots of a pixel in the grid of nodes.
  int slots() const { return many_samples() && !pool() ? nodes : 1; }
  /// Texels by which triangles are dilated: what a texel's own square asks for where nodes stand in every texel that
  /// they touch, the option's value where they do not (6.1).
  double dilation() const { return many_samples() && !pool() ? dilation_texels : 0.5; }
  /// Room for unsure pairs: as asked, or by the picture's size: at 32 samples one a pixel; the most seen is 0.97, of
  /// `powerplant` by the preset `paper`.
  int pairs(int width_px, int height_px) const;
  /// Whether pairs are listed to ask their alpha mask, and room for those of one dispatch.
  bool lists_alpha() const { return compute() && alpha == "exact"; }
  int asked_pairs(int width_px, int height_px) const;
  /// Layers of such a light that one draw of the casters reaches. More than eight would be more than a geometry shader
  /// may put out everywhere.
  int layers_a_pass(int faces) const { return cascade_pass == "single" ? std::min(cascades * faces, 8) : 1; }
};

}  // namespace izb

// SPDX-License-Identifier: MIT
// The options of the technique `shadow_map`.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/options.h"
#include "frame/samples.h"

namespace izb {

struct ShadowMapSettings {
  SampleOptions sampling{"1", "hammersley"};
  std::string filter = "pcf2x2", fit = "receivers";
  int resolution = 2048, cascades = 1;
  double radius_texels = 1.5, bias_texels = 0.5, slope_bias_texels = -1.0, normal_offset_texels = 0.0;
  double split_lambda = 0.5, distance = 0.0;
  bool receiver_plane = true, nl_cull = true;

  /// Declares every option, bound to this object.
  OptionSet options();

  bool many_samples() const { return sampling.spp != "1"; }
  /// Points of the disc; 0: none.
  int taps() const { return filter.starts_with("disc") ? std::stoi(filter.substr(4)) : 0; }
  /// Windows from the bounds stage; otherwise from the camera alone.
  bool fits_receivers() const { return fit == "receivers"; }
  bool stable() const { return fit == "stable"; }
  /// Texels over which a receiver's plane may rise: as asked for, or as many as the filter needs.
  double slope_bias() const;
  /// Texels around a window that the filter reads.
  int margin_texels() const;
  /// Where the filter's points lie, in texels from the receiver: spirals of equal area a point (Vogel 1979).
  std::vector<glm::vec2> tap_offsets() const;
};

}  // namespace izb

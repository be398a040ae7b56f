// SPDX-License-Identifier: MIT
#include "shadow/shadow_map/settings.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace izb {
namespace {

// So that a margin on both sides leaves most of the smallest map to the receivers.
constexpr double largest_radius_texels = 16.0;
constexpr int smallest_resolution = 64;
// Of the receiver's plane at a texel's centre: vertices snap to 1/256 texel, and neighbouring planes differ a little.
constexpr double slope_bias_on_plane_texels = 0.1;

}  // namespace

OptionSet ShadowMapSettings::options() {
  OptionSet set;
  sampling.declare(set);
  set.integer("resolution", resolution, smallest_resolution, 16384, "texels", "side of the depth map");
  set.integer("cascades", cascades, 1, 8, "cascades", "depth maps, each for a part of the depth range");
  set.choice("fit", fit, {"receivers", "camera", "stable"},
             "where the cascades lie: tight around the visible receivers, split logarithmically, as those of izb "
             "(sample distribution shadow maps); around parts of the camera's frustum; or the same with windows of "
             "fixed size that move by whole texels, so that shadows do not crawl");
  set.number("split-lambda", split_lambda, 0.0, 1.0, "",
             "of the fits camera and stable: where the frustum is split, from 0, uniformly, to 1, logarithmically");
  set.number("distance", distance, 0.0, std::numeric_limits<double>::infinity(), "world units",
             "of the fits camera and stable: eye distance at which shadows end; 0: the camera's far plane or, where it "
             "has none, the scene's end");
  set.choice("filter", filter, {"none", "pcf2x2", "disc8", "disc16", "disc32"},
             "percentage-closer filtering: one texel; hardware's 2 x 2; or 8, 16 or 32 points of a disc");
  set.number("radius", radius_texels, 0.0, largest_radius_texels, "texels", "of the disc");
  set.number("bias", bias_texels, 0.0, 64.0, "texels",
             "by which a receiver is moved along its ray to the light; a texel is as wide as at the receiver");
  set.number("slope-bias", slope_bias_texels, -1.0, 64.0, "texels",
             "and by the depth that its own plane rises over so many texels along both axes; below 0: as many as the "
             "filter needs");
  set.number("normal-offset", normal_offset_texels, 0.0, 64.0, "texels",
             "by which a receiver is moved along its normal before, times the sine of the angle to the light");
  set.flag("receiver-plane", receiver_plane,
           "compare each texel of the filter with the depth of the receiver's plane at its centre, not with the "
           "receiver's own");
  set.flag("nl-cull", nl_cull, "look up no pixels with N.L <= 0");
  return set;
}

double ShadowMapSettings::slope_bias() const {
  if (slope_bias_texels >= 0.0) return slope_bias_texels;
  if (filter == "pcf2x2") return 1.0;
  if (receiver_plane) return slope_bias_on_plane_texels;
  return taps() > 0 ? radius_texels + 0.5 : 0.5;
}

int ShadowMapSettings::margin_texels() const {
  return taps() > 0 ? static_cast<int>(std::ceil(radius_texels)) : 0;
}

std::vector<glm::vec2> ShadowMapSettings::tap_offsets() const {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::vec2> offsets;
  for (int i = 0; i < taps(); ++i) {
    const double r = radius_texels * std::sqrt((i + 0.5) / taps()), angle = golden_angle * i;
    offsets.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return offsets;
}

}  // namespace izb

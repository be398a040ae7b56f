// SPDX-License-Identifier: MIT
#include "shadow/izb/settings.h"

#include <algorithm>

#include "base/error.h"

namespace izb {

OptionSet IzbSettings::options() {
  OptionSet set;
  sampling.declare(set);
  set.choice("coverage", coverage, {"lut", "exact"},
             "at 32 samples: by the visibility look-up table (4), or sample by sample");
  set.choice("lut", lut, {"32", "64", "128"}, "side of the look-up table; the paper's is 32");
  set.choice(
      "insertion", insertion, {"approximate", "nv", "samples", "exact"},
      "at 32 samples, where a pixel's nodes go (6.1): as few texels along its long axis as answer for all of its "
      "micro-quad, a row along the view ray counted by N.V alone, the texels of its samples, or every texel that its "
      "micro-quad touches");
  set.integer("nodes", nodes, 1, 8, "nodes", "at most so many a pixel, but for exact insertion (6.1)");
  set.number("dilation", dilation_texels, 0.5, 4.0, "texels",
             "by which triangles grow in light space (6.1); exact insertion needs and takes 0.5");
  set.choice(
      "alpha", alpha, {"exact", "fragment", "off"},
      "of casters with an alpha mask: asked where each sample's line to the light meets them, once a fragment of "
      "the light-space grid, or not at all, so that they cast as opaque");
  set.choice("raster", raster, {"gs", "hw", "compute"},
             "gs: dilate triangles in a geometry shader; hw: by the hardware's conservative rasteriser and a "
             "pass-through geometry shader, which NVIDIA GPUs have since GM204 (7); compute: walk the lists in a "
             "compute shader, an invocation for each triangle or tile of a large one");
  set.integer("compute-texels", compute_texels, 0, 1 << 28, "texels",
              "of --raster compute: triangles that may touch more are left to the geometry shader");
  set.integer(
      "compute-rounds", compute_rounds, 0, 512, "rounds",
      "of --raster compute: after so many tests and texels a triangle's sweep goes on in another dispatch, and after "
      "twice as many in the next one, so that lanes do not wait for long ones; 0: in one go");
  set.integer("grid", grid, 16, 16384, "texels", "side of the light-space grid of lists (6.3)");
  set.number("grid-density", grid_density, 0.0, 1000.0, "texels a receiver",
             "a grid whose window holds few receivers uses no more texels than that for each, since small texels only "
             "meet more triangles; 0: all of its texels (6.3)");
  set.integer("cascades", cascades, 1, 8, "cascades", "grids, by a logarithmic split of the visible depth range (6.4)");
  set.choice("cascade-pass", cascade_pass, {"single", "multiple"},
             "draw the casters once for all cascades, or once for each as in the paper (5.5)");
  set.flag("removal", removal, "unlink the nodes of fully shadowed pixels (6.6)");
  set.flag("unchanged-skip", unchanged_skip, "no atomic where the mask has the bits already (6.7)");
  set.flag("pipelining", pipelining, "fetch each node one round of the walk ahead (6.8)");
  set.flag("nl-cull", nl_cull, "leave pixels with N.L <= 0 out of the lists (6.5)");
  set.flag("zcull", zcull, "light-space culling prepass and early z (5.4)");
  set.flag("zcull-pyramid", zcull_pyramid,
           "with z-cull, end triangles that no receiver lies behind in the geometry shader, by a pyramid of furthest "
           "depths");
  set.flag("occluders", occluders,
           "before the lists are made, a depth map of triangles that surely cover whole texels of the grid: receivers "
           "behind it are in full shadow and get no node (Tokuyoshi and Mizokuchi 2018)");
  set.integer(
      "pairs", pair_capacity, by_size, 1 << 24, "pairs",
      "room for triangle-pixel pairs that single precision cannot decide; when it is exceeded a second pass "
      "decides them in double; -1: by the picture, one for 16 pixels, or at 32 samples for each. --raster compute has "
      "as much room for pairs whose alpha mask is to be asked, with -1 one for each pixel");
  return set;
}

int IzbSettings::pairs(int width_px, int height_px) const {
  if (pair_capacity != by_size) return pair_capacity;
  const int64_t pixels = int64_t(width_px) * height_px;
  return static_cast<int>(std::clamp<int64_t>(pixels / (many_samples() ? 1 : 16), 4096, 1 << 24));
}

int IzbSettings::asked_pairs(int width_px, int height_px) const {
  if (pair_capacity != by_size) return pair_capacity;
  return static_cast<int>(std::clamp<int64_t>(int64_t(width_px) * height_px, 4096, 1 << 24));
}

std::vector<std::string> IzbSettings::preset_names() {
  return {"paper", "exact", "fast"};
}

void IzbSettings::apply(const std::string& preset) {
  if (preset == "paper") {  // table 1: four cascades of 2048 x 2048, every optimisation of section 6
    sampling = {"32", "halton", "tangent"};
    lut = "32";
    insertion = "nv";
    alpha = "fragment";
    cascades = 4;
    cascade_pass = "multiple";
    grid_density = 0.0;
    occluders = false;
    removal = unchanged_skip = pipelining = true;
  } else if (preset == "exact") {
    sampling.spp = "32";
    coverage = insertion = alpha = "exact";
    pair_capacity = 1 << 22;
  } else if (preset == "fast") {  // leaks a little, and cuts alpha masks as coarsely as the grid
    sampling.spp = "32";
    coverage = "lut";
    insertion = "approximate";
    nodes = 2;
    alpha = "fragment";
  } else {
    throw UsageError(fmt::format("unknown preset '{}': there are {}", preset, fmt::join(preset_names(), ", ")));
  }
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// Which program each stage of the technique `izb` takes, by its options and the kind of the light.
#pragma once
#include <array>
#include <vector>

#include "gpu/program.h"
#include "shadow/izb/settings.h"

namespace izb {

/// The programs of the technique's stages.
enum class IzbProgram {
  occluders,
  build,
  count_nodes,
  zcull,
  pyramid_first,
  pyramid,
  visibility,
  visibility_in_double,
  visibility_counted,
  visibility_counted_all,
  visibility_tests,      ///< counted, also by pixel
  visibility_fragments,  ///< counted, also by texel
  visibility_stored,     ///< each test goes into a list
  hardware,              ///< of --raster hw, before the one of the same variant above
  hardware_in_double,
  hardware_counted,
  hardware_tests,
  hardware_fragments,
  hardware_stored,
  list,  ///< of --raster compute, before a sweep
  list_all,
  tiles,  ///< after `list`, of large triangles
  tiles_counted,
  tiles_counted_all,
  sweep,  ///< before the one of the same variant above, which gets the other triangles
  sweep_counted,
  sweep_counted_all,
  sweep_tests,
  sweep_fragments,
  sweep_stored,
  alpha,  ///< after a sweep of masked casters
  alpha_counted,
  speed_of_light,  ///< the tests of that list
  settle,
  overflow,
  count
};

/// Of what a software renderer would run for every light though only one kind needs it.
/// A cube is a positional light with six grids.
enum class LightKind { directional, positional, cube };

/// What --raster hw draws, and --raster compute sweeps, before a variant of `visibility`; nothing is swept in double
/// (count).
struct Beside {
  IzbProgram hardware, sweep;
};
Beside beside(IzbProgram visibility);
/// Whether it has a variant for casters with an alpha mask.
bool knows_masks(IzbProgram program, const IzbSettings& settings);

/// `masked`: of casters with an alpha mask; of `settle` and `speed_of_light`, of casters among which there are such.
gpu::ProgramSpec izb_program_spec(IzbProgram program, const IzbSettings& settings, LightKind light,
                                  bool masked = false);

/// Every program of the defaults, of each option alone from the defaults, and of the presets, for each kind of light.
std::vector<gpu::ProgramSpec> izb_program_specs();

/// The programs of one setting at a time, compiled when a frame's light first needs them.
class IzbPrograms {
 public:
  /// Keeps those that are the same under the new settings.
  void follow(const IzbSettings& settings);
  /// Compiles what frames under such a light need, with masked casters or without, so that nothing is compiled within a
  /// stage.
  void prepare(LightKind light, bool masked_casters);
  /// Of the light that was prepared last; compiles if it must.
  const gpu::Program& operator[](IzbProgram program) { return get(program, false); }
  const gpu::Program& get(IzbProgram program, bool masked);

 private:
  IzbSettings settings_;
  LightKind light_ = LightKind::directional;
  std::array<gpu::Program, static_cast<size_t>(IzbProgram::count)>
      programs_[3][2];  ///< by the kind of light, and whether of masked casters
};

}  // namespace izb

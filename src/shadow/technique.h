// SPDX-License-Identifier: MIT
// The door of a room: FrameInputs in, Visibility out. A technique's memory is its own members.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "frame/frame_inputs.h"
#include "gpu/capabilities.h"
#include "gpu/glsl_front_end.h"
#include "gpu/memory.h"
#include "gpu/timers.h"

namespace izb {

struct TechniqueInfo {
  std::string name;      ///< as `--technique` takes it
  std::string line;      ///< what it does, one line
  std::string citation;  ///< the paper, or empty
};

/// Named counts of one frame, in order of display.
using Counts = std::vector<std::pair<std::string, uint64_t>>;

/// What the tests of one frame take when nothing but them is done (Wyman et al. 2015, table 2).
struct SpeedOfLight {
  uint64_t tests = 0;  ///< frustum-triangle tests of the frame, each one invocation
  std::vector<double>
      ms;  ///< of each repeat: all of the tests, and those in double that single precision left undecided
  bool same_mask = false;  ///< every repeat gave the frame's mask, bit for bit
};

class Technique {
 public:
  virtual ~Technique() = default;
  Technique() = default;
  Technique(const Technique&) = delete;
  Technique& operator=(const Technique&) = delete;

  virtual TechniqueInfo info() const = 0;
  /// Its options, bound to this object.
  virtual OptionSet options() = 0;
  /// Names of whole settings, and what sets one: before options() is asked for, so that its values are the defaults
  /// there. Throws izb::UsageError for an unknown name.
  virtual std::vector<std::string> presets() const { return {}; }
  virtual void apply_preset(const std::string& name);
  /// What the driver lacks for it: one sentence, or empty.
  virtual std::string missing(const gpu::Capabilities& capabilities) const = 0;
  /// Where its samples lie, from its options. Throws izb::Error if a pattern's file cannot be read.
  virtual SamplePattern samples() const = 0;
  /// What it asks of the light-space grid that the bounds stage fits.
  virtual GridRequest grid() const = 0;
  /// Compiles and allocates for a shape and the options' values, as far as what is there does not serve. Throws
  /// izb::Error if the driver refuses.
  virtual void resize(const FrameShape& shape) = 0;
  /// Fills `out.mask`. Uniform blocks of camera and light, and the light's window, are bound.
  virtual void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) = 0;
  /// Why the frame just rendered is not what it should be: one sentence, or empty.
  virtual std::string fault() const { return {}; }
  /// Renders once more with counting on; out.mask is as after render(). `unculled`: also what a frame without culling
  /// would do, which takes as long as such a frame.
  virtual Counts count(const FrameInputs& in, Visibility& out, bool unculled) = 0;
  /// GPU memory of its own, by name, in bytes; the mask is the frame's.
  virtual Counts memory() const = 0;
  /// What resize() would take with the options as they are, part by part as memory() names them. Needs no GL.
  virtual gpu::Plan memory_needed(const FrameShape& shape) const = 0;
  /// Of the last frame's lists as they were built: length of the longest in which each pixel stands (bottom row first),
  /// or empty if it has no lists.
  virtual std::vector<float> list_lengths(const FrameInputs&) { return {}; }
  /// Of the same, entry n: how many lists have n nodes; empty if it has no lists.
  virtual std::vector<uint64_t> list_histogram(const FrameInputs&) { return {}; }
  /// Of the last frame, by a frame of their own; out.mask is as after render(). Frustum-triangle tests that each pixel
  /// took part in (bottom row first), and fragments that arrived in each texel of the light-space grid after z-cull, of
  /// all layers, as IzbInternals::texel() counts them; empty if it has none.
  virtual std::vector<float> tests_a_pixel(const FrameInputs&, Visibility&) { return {}; }
  virtual std::vector<float> fragments_a_texel(const FrameInputs&, Visibility&) { return {}; }
  /// Stores the tests of the last frame and times them alone, `repeats` times, at least once; out.mask is as after
  /// render(). Nothing if it has no such tests. Throws izb::Error if there is no memory for their list, or it cannot
  /// address them.
  virtual std::optional<SpeedOfLight> speed_of_light(const FrameInputs&, Visibility&, int /*repeats*/) { return {}; }
  /// Every program that it can compile: the defaults and each option alone. Needs no GL.
  virtual std::vector<gpu::ProgramSpec> program_specs() const = 0;
};

/// The names of all techniques.
std::vector<std::string> technique_names();
/// Throws izb::UsageError for an unknown name.
std::unique_ptr<Technique> make_technique(const std::string& name);

}  // namespace izb

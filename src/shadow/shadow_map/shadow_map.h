// SPDX-License-Identifier: MIT
// Shadow maps: L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978, filtered after Reeves, Salesin
// and Cook 1987, in cascades that fit the visible receivers (Lauritzen, Salvi and Lefohn 2011) or the camera.
#pragma once
#include <optional>

#include "gpu/program.h"
#include "scene/view.h"
#include "shadow/shadow_map/fixed_windows.h"
#include "shadow/shadow_map/settings.h"
#include "shadow/technique.h"
#include "shared/depth_map.h"

namespace izb {

/// The programs of the technique.
enum class ShadowMapProgram { build, build_masked, visibility, visibility_counted, count };

gpu::ProgramSpec shadow_map_program_spec(ShadowMapProgram program, const ShadowMapSettings& settings,
                                         const gpu::Defines& geometry);

class ShadowMap final : public Technique {
 public:
  TechniqueInfo info() const override {
    return {"shadow_map", "depth maps in cascades with percentage-closer filtering",
            "L. Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978"};
  }

  OptionSet options() override { return settings_.options(); }
  std::string missing(const gpu::Capabilities& capabilities) const override;
  SamplePattern samples() const override { return settings_.sampling.samples(); }
  GridRequest grid() const override;
  void resize(const FrameShape& shape) override;
  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override;
  /// `fragments_in_map`: of casters, that passed the depth test; `lookups`: samples of receivers, of which the map does
  /// not reach `lookups_outside`; `comparisons`: of texels with a receiver.
  Counts count(const FrameInputs& in, Visibility& out, bool unculled) override;
  Counts memory() const override;
  gpu::Plan memory_needed(const FrameShape& shape) const override;
  std::vector<gpu::ProgramSpec> program_specs() const override;

  const ShadowMapSettings& settings() const { return settings_; }
  /// Depths of the last frame, all layers, bottom row first; for checks.
  std::vector<float> read_map() const;
  /// The windows that they were drawn in, where the camera alone decides; for checks.
  const FixedWindows& fixed_windows() const { return fixed_; }

 private:
  const gpu::Program& get(ShadowMapProgram program);
  /// Windows of the frame, bound, if the bounds stage's are not to be used.
  void fit(const FrameInputs& in);
  void build(const FrameInputs& in);
  void visibility(const FrameInputs& in, Visibility& out, ShadowMapProgram program);
  /// Texels that shaders widen windows by: fixed ones have them already.
  float margin() const { return built_.fits_receivers() ? float(built_.margin_texels()) : 0.0f; }
  double shadow_distance(const FrameInputs& in);

  ShadowMapSettings settings_, built_;  ///< as the options say; as resize() found them
  gpu::Defines geometry_;
  gpu::Program programs_[static_cast<size_t>(ShadowMapProgram::count)];
  gpu::Texture map_;  ///< a layer for each cascade of each face
  std::vector<gpu::Framebuffer> framebuffers_;
  gpu::Sampler hardware_filter_;
  gpu::Buffer windows_, range_, counters_;
  FixedWindows fixed_;
  std::optional<PosedBounds> posed_bounds_;  ///< once a frame has needed them
};

std::unique_ptr<Technique> make_shadow_map();

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "shadow/ray_traced/ray_traced.h"

#include <optional>

#include "frame/read_back.h"
#include "frame/spine.h"
#include "reference/embree.h"
#include "shadow/ray_traced/receivers.h"

namespace izb {
namespace {

class RayTraced final : public Technique {
 public:
  TechniqueInfo info() const override {
    return {"ray_traced", "one shadow ray a sample by Embree on the CPU, at the points that the G-buffer holds",
            "I. Wald, S. Woop, C. Benthin, G. Johnson, M. Ernst: Embree, SIGGRAPH 2014"};
  }

  OptionSet options() override {
    OptionSet set;
    sampling_.declare(set);
    set.choice("quality", quality_, {"low", "medium", "high"}, "build quality of the hierarchy");
    set.flag("nl-cull", nl_cull_, "trace no rays for pixels with N.L <= 0");
    return set;
  }

  std::string missing(const gpu::Capabilities&) const override {
    return reference::embree_available() ? "" : "this build has no Embree";
  }
  SamplePattern samples() const override { return sampling_.samples(); }
  GridRequest grid() const override { return {1, nl_cull_}; }
  void resize(const FrameShape&) override {}

  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override {
    const gpu::StageTimers::Scope scope(timers, name(Stage::visibility));
    trace(in, out);
  }

  Counts count(const FrameInputs& in, Visibility& out, bool) override { return {{"rays", trace(in, out)}}; }
  Counts memory() const override { return {}; }
  gpu::Plan memory_needed(const FrameShape&) const override { return {}; }
  std::vector<gpu::ProgramSpec> program_specs() const override { return {}; }

 private:
  reference::BuildQuality quality() const {
    return quality_ == "low"      ? reference::BuildQuality::low
           : quality_ == "medium" ? reference::BuildQuality::medium
                                  : reference::BuildQuality::high;
  }

  /// A hierarchy over the frame's triangles: that of the frame before where the renderer says that they are the same.
  const reference::RayTracer& tracer_of(const FrameInputs& in) {
    const Built wanted{in.geometry, quality()};
    if (in.geometry == 0 || !tracer_ || built_ != wanted) {
      tracer_.reset();  // two have no room
      tracer_.emplace(make_triangles(in), wanted.quality);
      built_ = wanted;
    }
    return *tracer_;
  }

  uint64_t trace(const FrameInputs& in, Visibility& out) {
    const uint64_t rays = trace(tracer_of(in), in, out);
    if (in.geometry == 0) tracer_.reset();
    return rays;
  }

  static uint64_t trace(const reference::RayTracer& tracer, const FrameInputs& in, Visibility& out) {
    const reference::Receivers receivers = make_receivers(read_gbuffer(*in.gbuffer), in);
    const reference::MaskTrace traced = tracer.trace_mask(make_light_point(in.light), receivers);
    const std::vector<uint32_t> bottom_first = flip_rows(traced.mask, in.width_px, in.height_px);
    glTextureSubImage2D(out.mask.name(), 0, 0, 0, in.width_px, in.height_px, GL_RED_INTEGER, GL_UNSIGNED_INT,
                        bottom_first.data());
    return traced.rays;
  }

  /// What a hierarchy was built of, and how.
  struct Built {
    uint64_t geometry = 0;
    reference::BuildQuality quality{};
    bool operator==(const Built&) const = default;
  };

  SampleOptions sampling_;
  std::string quality_ = "medium";
  bool nl_cull_ = true;
  std::optional<reference::RayTracer> tracer_;  ///< kept between frames of the same geometry only
  Built built_;
};

}  // namespace

std::unique_ptr<Technique> make_ray_traced() {
  return std::make_unique<RayTraced>();
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// A technique that shows a mask made elsewhere: the ray-traced truth of the viewer, traced in the background.
#pragma once
#include <vector>

#include "shadow/technique.h"

namespace izb {

class GivenMask final : public Technique {
 public:
  /// `samples` are those of the masks to come.
  explicit GivenMask(SamplePattern samples) : samples_(std::move(samples)) {}
  /// Of each light of the frames to come, top row first; none: nothing is shadowed yet.
  void give(std::vector<std::vector<uint32_t>> masks) { masks_ = std::move(masks); }

  TechniqueInfo info() const override {
    return {"truth", "one shadow ray a sample by Embree on the CPU, settled nowhere", ""};
  }
  OptionSet options() override { return {}; }
  std::string missing(const gpu::Capabilities&) const override { return {}; }
  SamplePattern samples() const override { return samples_; }
  GridRequest grid() const override { return {1, true}; }
  void resize(const FrameShape&) override { next_ = 0; }
  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override;
  Counts count(const FrameInputs&, Visibility&, bool) override { return {}; }
  Counts memory() const override { return {}; }
  gpu::Plan memory_needed(const FrameShape&) const override { return {}; }
  std::vector<gpu::ProgramSpec> program_specs() const override { return {}; }

 private:
  SamplePattern samples_;
  std::vector<std::vector<uint32_t>> masks_;
  size_t next_ = 0;  ///< the light that is rendered next
};

}  // namespace izb

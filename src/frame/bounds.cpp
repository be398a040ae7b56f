// SPDX-License-Identifier: MIT
#include "frame/bounds.h"

#include "frame/spine.h"
#include "shared/bindings.h"
#include "shared/bounds.h"

namespace izb {
namespace {

constexpr int threads_a_group = 64;
constexpr int groups = 256;  // persistent threads: enough to fill a GPU, few enough for atomics at their end

}  // namespace

std::vector<gpu::ProgramSpec> BoundsStage::program_specs() {
  return {{"bounds", {"frame/2_bounds.comp.glsl"}, {}}, {"bounds window", {"frame/2_bounds_window.comp.glsl"}, {}}};
}

BoundsStage::BoundsStage()
    : reduce_(program_specs()[0]),
      window_program_(program_specs()[1]),
      bounds_("receiver bounds", sizeof(shared::ReceiverBounds)),
      window_("light window", sizeof(shared::LightWindow)) {}

void BoundsStage::render(gpu::StageTimers& timers) {
  const gpu::StageTimers::Scope scope(timers, name(Stage::bounds));
  const shared::ReceiverBounds empty{glm::uvec4(~0u), glm::uvec4(0u), glm::uvec4(0u)};
  bounds_.update(0, sizeof empty, &empty);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_BOUNDS, bounds_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_WINDOW, window_.name());
  reduce_.dispatch(threads_a_group * groups, 1, threads_a_group, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  window_program_.dispatch(1, 1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

shared::LightWindow BoundsStage::read_window() const {
  return window_.read<shared::LightWindow>(1)[0];
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "frame/bounds.h"

#include <algorithm>

#include "frame/spine.h"
#include "shared/bindings.h"
#include "shared/bounds.h"

namespace izb {
namespace {

constexpr int threads_a_group = 64;
constexpr int groups = 256;  // persistent threads: enough to fill a GPU, few enough for atomics at their end

constexpr int most_layers_a_pass = 8;  // whose extremes a thread holds

int faces_a_pass(int cascades) {
  return std::min(most_layers_a_pass / cascades, shared::cube_faces);
}

gpu::ProgramSpec reduce_spec(bool micro_quads, int cascades, bool cube) {
  gpu::ProgramSpec spec{"bounds", {"frame/2_bounds.comp.glsl"}, {{"CASCADES", std::to_string(cascades)}}};
  spec.defines["LAYERS"] = std::to_string(cube ? cascades * faces_a_pass(cascades) : cascades);
  if (micro_quads) spec.defines["MICRO_QUAD"] = "1";
  if (cube) spec.defines["CUBE"] = "1";
  return spec;
}

gpu::ProgramSpec window_spec(bool micro_quads) {
  gpu::ProgramSpec spec{"bounds window", {"frame/2_bounds_window.comp.glsl"}, {}};
  if (micro_quads) spec.defines["MICRO_QUAD"] = "1";
  return spec;
}

}  // namespace

std::vector<gpu::ProgramSpec> BoundsStage::program_specs() {
  std::vector<gpu::ProgramSpec> specs{{"bounds range", {"frame/2_bounds_range.comp.glsl"}, {}},
                                      {"bounds split", {"frame/2_bounds_split.comp.glsl"}, {}},
                                      window_spec(false),
                                      window_spec(true)};
  for (const bool micro_quads : {false, true})
    for (const int cascades : {1, shared::max_cascades})
      for (const bool cube : {false, true}) specs.push_back(reduce_spec(micro_quads, cascades, cube));
  return specs;
}

BoundsStage::BoundsStage()
    : range_program_(program_specs()[0]),
      split_program_(program_specs()[1]),
      bounds_("receiver bounds", sizeof(shared::ReceiverBounds) * shared::max_layers),
      windows_("light windows", sizeof(shared::LightWindow) * shared::max_layers),
      cascades_buffer_("cascades", sizeof(shared::CascadeRange)) {}

void BoundsStage::prepare(bool micro_quads, int cascades) {
  window_program_.become(window_spec(micro_quads));
  if (micro_quads == micro_quads_ && cascades == cascades_) return;
  reduce_ = gpu::Program();
  reduce_cube_ = gpu::Program();
  micro_quads_ = micro_quads;
  cascades_ = cascades;
}

void BoundsStage::render(int faces, gpu::StageTimers& timers) {
  gpu::Program& reduce = faces > 1 ? reduce_cube_ : reduce_;
  if (!reduce) reduce = gpu::Program(reduce_spec(micro_quads_, cascades_, faces > 1));
  const gpu::StageTimers::Scope scope(timers, name(Stage::bounds));
  const std::vector<shared::ReceiverBounds> empty(shared::max_layers,
                                                  {glm::uvec4(~0u), glm::uvec4(0u), glm::uvec4(0u)});
  bounds_.update(0, bounds_.bytes(), empty.data());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_BOUNDS, bounds_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_WINDOW, windows_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_CASCADES, cascades_buffer_.name());
  if (cascades_ > 1) {
    shared::CascadeRange fresh{};
    fresh.reached.x = ~0u;
    cascades_buffer_.update(0, sizeof fresh, &fresh);
    range_program_.dispatch(threads_a_group * groups, 1, threads_a_group, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    split_program_.dispatch(1, 1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  reduce.use();
  for (int first = 0; first < faces; first += faces_a_pass(cascades_)) {
    if (faces > 1) glUniform1i(0, first * cascades_);
    reduce.dispatch(threads_a_group * groups, 1, threads_a_group, 1);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  window_program_.dispatch(1, 1, 1, 1);
  // Read as uniform blocks: a software renderer reads storage lane by lane.
  glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  bind();
}

void BoundsStage::bind() const {
  glBindBufferBase(GL_UNIFORM_BUFFER, BIND_WINDOWS, windows_.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, BIND_CASCADE_ENDS, cascades_buffer_.name());
}

shared::LightWindow BoundsStage::read_window(int layer) const {
  return windows_.read<shared::LightWindow>(shared::max_layers)[static_cast<size_t>(layer)];
}

shared::CascadeRange BoundsStage::read_cascades() const {
  return cascades_buffer_.read<shared::CascadeRange>(1)[0];
}

}  // namespace izb

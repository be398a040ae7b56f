// SPDX-License-Identifier: MIT
#include "shadow/renderer.h"

#include "base/error.h"
#include "frame/read_back.h"
#include "shared/bindings.h"
#include "shared/lists.h"

namespace izb {
namespace {

uint64_t sum_of(const Counts& counts) {
  uint64_t sum = 0;
  for (const auto& [name, count] : counts) sum += count;
  return sum;
}

}  // namespace

Renderer::Renderer(const Scene& scene, const gpu::Capabilities& capabilities)
    : scene_(scene),
      capabilities_(capabilities),
      buffers_(scene, make_draw_list(scene), capabilities),
      camera_block_("camera", BIND_CAMERA),
      light_block_("light", BIND_LIGHT),
      shade_block_("shade", BIND_SHADE),
      samples_block_("samples", BIND_SAMPLES) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void Renderer::prepare(Technique& technique, int width_px, int height_px) {
  const int64_t largest = std::min<int64_t>(capabilities_.max_texture_size, shared::largest_picture_px);
  if (width_px < 1 || height_px < 1 || width_px > largest || height_px > largest)
    fail("size {}x{} is outside what this GL driver takes, 1 to {} pixels a side", width_px, height_px, largest);
  if (const std::string reason = technique.missing(capabilities_); !reason.empty())
    fail("technique '{}' cannot run: {}", technique.info().name, reason);
  // What this object and the technique hold already is replaced, or needed again.
  const uint64_t held = buffers_.bytes() + gbuffer_.gbuffer().bytes() + shade_.picture().bytes() +
                        visibility_.mask.bytes() + sum_of(technique.memory());
  room_ = gpu::memory_room(capabilities_, held);
  gpu::expect_room(memory_needed(technique, width_px, height_px), room_, capabilities_);
  technique_ = &technique;
  inputs_.samples = technique.samples();
  const bool micro_quads = inputs_.samples.count() > 1;
  gbuffer_.resize(width_px, height_px, micro_quads);
  bounds_.prepare(micro_quads, technique.grid().cascades);
  samples_block_.set(make_sample_frame(inputs_.samples, technique.grid()));
  shade_.resize(width_px, height_px);
  visibility_.mask = gpu::Texture("mask", GL_R32UI, width_px, height_px);
  technique.resize(width_px, height_px);
  inputs_.width_px = width_px;
  inputs_.height_px = height_px;
  inputs_.gbuffer = &gbuffer_.gbuffer();
  inputs_.first_triangle = &buffers_.draw_list().first_triangle;
  inputs_.draw_casters = [this] { buffers_.draw_casters(); };
  inputs_.triangles_vs = [this]() -> const std::vector<glm::vec3>& {
    if (triangles_vs_.empty()) triangles_vs_ = flatten(scene_, buffers_.draw_list(), instances_);
    return triangles_vs_;
  };
}

void Renderer::render(const Camera& camera, const Light& light, gpu::StageTimers& timers) {
  inputs_.camera = make_camera_frame(camera, inputs_.width_px, inputs_.height_px);
  inputs_.light = make_light_frame(camera, light, technique_->grid());
  instances_ = make_instance_frames(camera, scene_, buffers_.draw_list());
  triangles_vs_.clear();
  buffers_.update_instances(instances_);
  camera_block_.set(inputs_.camera);
  light_block_.set(inputs_.light);
  shade_block_.set(make_shade_frame(camera, light));
  camera_block_.bind();
  light_block_.bind();
  shade_block_.bind();
  samples_block_.bind();

  gbuffer_.render(buffers_, timers);
  bounds_.render(timers);
  technique_->render(inputs_, visibility_, timers);
  shade_.render(visibility_.mask, timers);
}

std::vector<uint32_t> Renderer::read_mask() const {
  if (const std::string fault = technique_->fault(); !fault.empty())
    fail("technique '{}': {}", technique_->info().name, fault);
  return izb::read_mask(visibility_.mask);
}

Counts Renderer::count() {
  return technique_->count(inputs_, visibility_);
}

Counts Renderer::memory() const {
  Counts counts;
  counts.emplace_back(technique_->info().name, sum_of(technique_->memory()) + visibility_.mask.bytes());
  counts.emplace_back("gbuffer", gbuffer_.gbuffer().bytes() + shade_.picture().bytes());
  counts.emplace_back("scene", buffers_.bytes());
  return counts;
}

gpu::Plans Renderer::memory_needed(const Technique& technique, int width_px, int height_px) const {
  gpu::Plan its = technique.memory_needed(width_px, height_px);
  its.push_back(gpu::planned_texture("mask", GL_R32UI, width_px, height_px, {"--size"}));
  gpu::Plan gbuffer = GBuffer::memory_needed(width_px, height_px, technique.samples().count() > 1);
  for (gpu::Planned& p : ShadeStage::memory_needed(width_px, height_px)) gbuffer.push_back(std::move(p));
  return {{technique.info().name, std::move(its)},
          {"gbuffer", std::move(gbuffer)},
          {"scene", SceneBuffers::memory_needed(scene_, buffers_.draw_list())}};
}

std::vector<gpu::ProgramSpec> Renderer::program_specs() {
  std::vector<gpu::ProgramSpec> all = GBufferStage::program_specs();
  const auto add = [&](std::vector<gpu::ProgramSpec> more) { all.insert(all.end(), more.begin(), more.end()); };
  add(BoundsStage::program_specs());
  add(ShadeStage::program_specs());
  for (const std::string& name : technique_names()) add(make_technique(name)->program_specs());
  return all;
}

}  // namespace izb

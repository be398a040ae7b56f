// SPDX-License-Identifier: MIT
#include "shadow/renderer.h"

#include <atomic>
#include <optional>
#include <span>
#include <stdexcept>

#include "base/error.h"
#include "frame/read_back.h"
#include "frame/spine.h"
#include "shared/bindings.h"
#include "shared/lists.h"

namespace izb {
namespace {

uint64_t sum_of(const Counts& counts) {
  uint64_t sum = 0;
  for (const auto& [name, count] : counts) sum += count;
  return sum;
}

/// Everything that pose() can change and the triangles in view space follow from, as it is in memory.
std::vector<std::byte> placement_of(const Scene& scene, const std::vector<shared::InstanceFrame>& instances) {
  std::vector<std::byte> bytes;
  const auto append = [&](const auto& values) {
    const auto more = std::as_bytes(std::span(values));
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  append(instances);
  for (const Instance& instance : scene.instances) {
    if (!instance.deforms()) continue;
    append(make_joint_frames(scene, instance));
    append(instance.morph_weights);
  }
  return bytes;
}

uint64_t new_geometry() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

int most_faces(const std::vector<Light>& lights, const GridRequest& grid) {
  int faces = 1;
  for (const Light& light : lights) faces = std::max(faces, grid_faces(light, grid));
  return faces;
}

}  // namespace

Renderer::Renderer(const Scene& scene, const gpu::Capabilities& capabilities, uint32_t part_triangles)
    : Renderer(scene, capabilities,
               std::make_shared<SceneBuffers>(scene, make_draw_list(scene, part_triangles), capabilities)) {}

Renderer::Renderer(const Scene& scene, const gpu::Capabilities& capabilities, std::shared_ptr<SceneBuffers> buffers)
    : scene_(scene),
      capabilities_(capabilities),
      buffers_(std::move(buffers)),
      camera_block_("camera", BIND_CAMERA),
      light_block_("light", BIND_LIGHT),
      shade_block_("shade", BIND_SHADE),
      samples_block_("samples", BIND_SAMPLES) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void Renderer::prepare(Technique& technique, int width_px, int height_px, const std::vector<Light>& lights) {
  const int64_t largest = std::min<int64_t>(capabilities_.max_texture_size, shared::largest_picture_px);
  if (width_px < 1 || height_px < 1 || width_px > largest || height_px > largest)
    fail("size {}x{} is outside what this GL driver takes, 1 to {} pixels a side", width_px, height_px, largest);
  if (const std::string reason = technique.missing(capabilities_); !reason.empty())
    fail("technique '{}' cannot run: {}", technique.info().name, reason);
  // What this object and the technique hold already is replaced, or needed again.
  uint64_t held =
      buffers_->bytes() + gbuffer_.gbuffer().bytes() + shade_.picture().bytes() + sum_of(technique.memory());
  for (const Visibility& v : visibility_) held += v.mask.bytes();
  room_ = gpu::memory_room(capabilities_, held);
  gpu::expect_room(memory_needed(technique, width_px, height_px, lights), room_, capabilities_);
  technique_ = &technique;
  common_ = {};  // and with it the number of what was kept
  common_.samples = technique.samples();
  const bool micro_quads = common_.samples.count() > 1;
  gbuffer_.resize(width_px, height_px, common_.samples, *buffers_);
  bounds_.prepare(micro_quads, technique.grid().cascades);
  samples_block_.set(make_sample_frame(common_.samples, technique.grid()));
  shade_.resize(width_px, height_px);
  visibility_.resize(lights.size());
  for (Visibility& v : visibility_) v.mask.become("mask", GL_R32UI, width_px, height_px);
  technique.resize({width_px, height_px, most_faces(lights, technique.grid()), buffers_->windows()});
  common_.width_px = width_px;
  common_.height_px = height_px;
  common_.gbuffer = &gbuffer_.gbuffer();
  common_.first_triangle = &buffers_->draw_list().first_triangle;
  common_.draw_casters = [this](Drawn drawn) { buffers_->draw_casters(drawn); };
  common_.for_casters = [this](Drawn drawn, uint32_t most, const std::function<void(uint32_t, uint32_t)>& draw) {
    buffers_->for_casters(drawn, most, draw);
  };
  common_.masked_casters = has_masked(buffers_->draw_list());
  common_.scene = &scene_;
  common_.draw_list = &buffers_->draw_list();
  common_.triangles_vs = [this]() -> const std::vector<glm::vec3>& {
    if (triangles_vs_.empty()) triangles_vs_ = flatten(scene_, buffers_->draw_list(), instances_);
    return triangles_vs_;
  };
}

void Renderer::select(size_t light, gpu::StageTimers& timers) {
  const shared::LightFrame& its = inputs_[light].light;
  light_block_.set(its);
  light_block_.bind();
  bounds_.render(static_cast<int>(its.grid.z), timers);
  selected_ = light;
}

// The technique holds the lists of the light that it rendered last. Another renderer of the same context, which may
// share the buffers, has bound its own and placed the scene before its own camera.
void Renderer::select_again(size_t light) {
  gpu::StageTimers untimed(false);
  if (buffers_->updates() != placed_) pose(untimed);
  bind_frame();
  if (light == selected_) {
    light_block_.set(inputs_[light].light);
    light_block_.bind();
    return bounds_.bind();
  }
  select(light, untimed);
  technique_->render(inputs_[light], visibility_[light], untimed);
}

void Renderer::bind_frame() {
  camera_block_.bind();
  samples_block_.bind();
  gbuffer_.gbuffer().bind();
}

void Renderer::render(const Camera& camera, const std::vector<Light>& lights, gpu::StageTimers& timers) {
  if (lights.size() != visibility_.size()) throw std::logic_error("a frame with other lights than were prepared for");
  common_.eye = camera;
  common_.camera = make_camera_frame(camera, common_.width_px, common_.height_px);
  instances_ = make_instance_frames(camera, scene_, buffers_->draw_list());
  renew_geometry();
  inputs_.assign(lights.size(), common_);
  faults_.assign(lights.size(), {});
  for (size_t i = 0; i < lights.size(); ++i)
    inputs_[i].light = make_light_frame(camera, common_.camera, lights[i], technique_->grid());
  pose(timers);
  camera_block_.set(common_.camera);
  bind_frame();

  gbuffer_.render(*buffers_, timers);
  for (size_t i = 0; i < lights.size(); ++i) {
    select(i, timers);
    technique_->render(inputs_[i], visibility_[i], timers);
    if (lights.size() > 1) faults_[i] = technique_->fault();  // the next light's frame takes its place
  }
  shade(camera, lights, timers);
}

void Renderer::keep_geometry(bool keep) {
  keeps_geometry_ = keep;
  common_.geometry = 0;
  placement_.clear();
}

void Renderer::renew_geometry() {
  if (keeps_geometry_) {
    std::vector<std::byte> placement = placement_of(scene_, instances_);
    if (common_.geometry != 0 && placement == placement_) return;
    placement_ = std::move(placement);
    common_.geometry = new_geometry();
  }
  triangles_vs_.clear();
}

void Renderer::pose(gpu::StageTimers& timers) {
  std::optional<gpu::StageTimers::Scope> scope;
  if (buffers_->deforms()) scope.emplace(timers, deform_name);
  buffers_->update(scene_, instances_);
  placed_ = buffers_->updates();
}

void Renderer::shade(const Camera& camera, const std::vector<Light>& lights, gpu::StageTimers& timers) {
  const gpu::StageTimers::Scope scope(timers, name(Stage::shade));
  const std::vector<double> weights = shade_weights(lights);
  const auto bind = [&](size_t light) {
    light_block_.set(inputs_[light].light);
    shade_block_.set(make_shade_frame(camera, lights[light], weights[light]));
    light_block_.bind();
    shade_block_.bind();
  };
  shade_.begin(given_exposure_.value_or(1.0f));
  if (!given_exposure_ && exposure_is_measured(lights)) {
    for (size_t i = 0; i < lights.size(); ++i) {
      bind(i);
      shade_.measure();
    }
    shade_.expose();
  }
  for (size_t i = 0; i < lights.size(); ++i) {
    bind(i);
    shade_.add(visibility_[i].mask, i == 0);
  }
}

std::vector<uint32_t> Renderer::read_mask(size_t light) const {
  const std::string fault = light_count() > 1 ? faults_[light] : technique_->fault();
  if (!fault.empty()) fail("technique '{}': {}", technique_->info().name, fault);
  return izb::read_mask(visibility_[light].mask);
}

Counts Renderer::count(size_t light, bool unculled) {
  select_again(light);
  return technique_->count(inputs_[light], visibility_[light], unculled);
}

std::vector<float> Renderer::list_lengths(size_t light) {
  select_again(light);
  return technique_->list_lengths(inputs_[light]);
}

std::vector<float> Renderer::tests_a_pixel(size_t light) {
  select_again(light);
  return technique_->tests_a_pixel(inputs_[light], visibility_[light]);
}

std::vector<float> Renderer::fragments_a_texel(size_t light) {
  select_again(light);
  return technique_->fragments_a_texel(inputs_[light], visibility_[light]);
}

std::optional<SpeedOfLight> Renderer::speed_of_light(size_t light, int repeats) {
  if (repeats < 1) throw std::logic_error("the speed of light of no repeat");
  select_again(light);
  return technique_->speed_of_light(inputs_[light], visibility_[light], repeats);
}

std::vector<uint64_t> Renderer::list_histogram(size_t light) {
  select_again(light);
  return technique_->list_histogram(inputs_[light]);
}

Counts Renderer::memory() const {
  uint64_t masks = 0;
  for (const Visibility& v : visibility_) masks += v.mask.bytes();
  Counts counts;
  counts.emplace_back(technique_->info().name, sum_of(technique_->memory()) + masks);
  counts.emplace_back("gbuffer", gbuffer_.gbuffer().bytes() + shade_.picture().bytes());
  counts.emplace_back("scene", buffers_->bytes());
  return counts;
}

gpu::Plans Renderer::memory_needed(const Technique& technique, int width_px, int height_px,
                                   const std::vector<Light>& lights) const {
  gpu::Plan its = technique.memory_needed({width_px, height_px, most_faces(lights, technique.grid())});
  for (size_t i = 0; i < lights.size(); ++i)
    its.push_back(gpu::planned_texture("mask", GL_R32UI, width_px, height_px, {"--size", "--light"}));
  gpu::Plan gbuffer = GBuffer::memory_needed(width_px, height_px, technique.samples().count() > 1);
  for (gpu::Planned& p : ShadeStage::memory_needed(width_px, height_px)) gbuffer.push_back(std::move(p));
  return {{technique.info().name, std::move(its)},
          {"gbuffer", std::move(gbuffer)},
          {"scene", SceneBuffers::memory_needed(scene_, buffers_->draw_list())}};
}

std::vector<gpu::ProgramSpec> Renderer::program_specs() {
  std::vector<gpu::ProgramSpec> all = GBufferStage::program_specs();
  const auto add = [&](std::vector<gpu::ProgramSpec> more) { all.insert(all.end(), more.begin(), more.end()); };
  add({DeformStage::program_spec()});
  add(BoundsStage::program_specs());
  add(ShadeStage::program_specs());
  for (const std::string& name : technique_names()) add(make_technique(name)->program_specs());
  return all;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "shadow/shadow_map/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "frame/spine.h"
#include "shared/bindings.h"

namespace izb {
namespace {

constexpr uint64_t windows_bytes = sizeof(shared::LightWindow) * shared::max_layers;

int layers_of(const shared::LightFrame& light) {
  return static_cast<int>(light.grid.y * light.grid.z);
}

}  // namespace

gpu::ProgramSpec shadow_map_program_spec(ShadowMapProgram program, const ShadowMapSettings& s,
                                         const gpu::Defines& geometry) {
  const std::string folder = "shadow/shadow_map/";
  if (program == ShadowMapProgram::build || program == ShadowMapProgram::build_masked) {
    gpu::ProgramSpec spec{"shadow map build", {folder + "3_build.vert.glsl", folder + "3_build.frag.glsl"}, {}};
    if (program == ShadowMapProgram::build) return spec;
    spec.defines = geometry;
    spec.defines["MASKED"] = "1";
    return spec;
  }
  gpu::ProgramSpec spec{"shadow map visibility", {folder + "5_visibility.comp.glsl"}, {}};
  if (s.many_samples()) spec.defines["SPP32"] = "1";
  if (s.filter == "pcf2x2") spec.defines["PCF"] = "1";
  if (s.taps() > 0) spec.defines["TAPS"] = std::to_string(s.taps());
  if (program == ShadowMapProgram::visibility_counted) spec.defines["COUNT"] = "1";
  return spec;
}

std::vector<gpu::ProgramSpec> ShadowMap::program_specs() const {
  using enum ShadowMapProgram;
  std::vector<gpu::ProgramSpec> specs;
  for (const char* spp : {"1", "32"})
    for (const char* filter : {"none", "pcf2x2", "disc8", "disc16", "disc32"})
      for (const ShadowMapProgram program : {visibility, visibility_counted}) {
        ShadowMapSettings settings;
        settings.sampling.spp = spp;
        settings.filter = filter;
        specs.push_back(shadow_map_program_spec(program, settings, {}));
      }
  specs.push_back(shadow_map_program_spec(build, {}, {}));
  for (const gpu::Defines& geometry :
       {gpu::Defines{}, {{"POSITION_WINDOWS", "2"}, {"INDEX_WINDOWS", "3"}, {"WINDOW_WORDS", "192u"}}})
    specs.push_back(shadow_map_program_spec(build_masked, {}, geometry));
  return specs;
}

std::string ShadowMap::missing(const gpu::Capabilities& capabilities) const {
  return settings_.resolution > capabilities.max_texture_size
             ? fmt::format("--resolution {} is beyond this driver's largest texture, {}", settings_.resolution,
                           capabilities.max_texture_size)
             : "";
}

GridRequest ShadowMap::grid() const {
  GridRequest request;
  request.texels = settings_.resolution;
  request.nl_cull = settings_.nl_cull;
  request.cascades = settings_.cascades;
  request.world_axes = settings_.stable();
  return request;
}

void ShadowMap::resize(const FrameShape& shape) {
  built_ = settings_;
  geometry_ = shape.geometry.defines();
  posed_bounds_.reset();
  for (size_t i = 0; i < std::size(programs_); ++i)
    if (!programs_[i].is(shadow_map_program_spec(static_cast<ShadowMapProgram>(i), built_, geometry_)))
      programs_[i] = gpu::Program();
  const int side = built_.resolution, layers = built_.cascades * shape.faces;
  if (map_.become_array("depth map", GL_DEPTH_COMPONENT32F, side, side, layers)) framebuffers_.clear();
  for (int layer = static_cast<int>(framebuffers_.size()); layer < layers; ++layer)
    framebuffers_.push_back(gpu::Framebuffer::depth_layer("depth map", map_, layer));
  if (!windows_) {
    windows_ = gpu::Buffer("fixed windows", windows_bytes);
    range_ = gpu::Buffer("fixed cascades", sizeof(shared::CascadeRange));
    counters_ = gpu::Buffer("shadow map counters", sizeof(shared::MapCounters));
  }
  if (hardware_filter_) return;
  hardware_filter_ = gpu::Sampler("hardware filter");
  const GLuint name = hardware_filter_.name();
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

const gpu::Program& ShadowMap::get(ShadowMapProgram program) {
  gpu::Program& made = programs_[static_cast<size_t>(program)];
  if (!made) made = gpu::Program(shadow_map_program_spec(program, built_, geometry_));
  return made;
}

void ShadowMap::render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) {
  // Nothing is compiled within a stage.
  get(ShadowMapProgram::build);
  get(ShadowMapProgram::visibility);
  if (in.masked_casters) get(ShadowMapProgram::build_masked);
  {
    const gpu::StageTimers::Scope scope(timers, name(Stage::build));
    fit(in);
    build(in);
  }
  const gpu::StageTimers::Scope scope(timers, name(Stage::visibility));
  visibility(in, out, ShadowMapProgram::visibility);
}

double ShadowMap::shadow_distance(const FrameInputs& in) {
  if (built_.distance > 0.0) return built_.distance;
  if (std::isfinite(in.eye.far_plane)) return in.eye.far_plane;
  if (!in.scene) fail("--fit {} takes a --distance where neither the camera nor a scene says where to end", built_.fit);
  if (!posed_bounds_) posed_bounds_.emplace(*in.scene);
  return distance_of_end(in.eye, posed_bounds_->of(*in.scene));
}

void ShadowMap::fit(const FrameInputs& in) {
  if (built_.fits_receivers()) return;
  fixed_ = make_fixed_windows(in.eye, in.camera, in.light,
                              {shadow_distance(in), built_.split_lambda, built_.stable(), built_.margin_texels()});
  windows_.update(0, windows_bytes, fixed_.windows.data());
  range_.update(0, sizeof fixed_.range, &fixed_.range);
  glBindBufferBase(GL_UNIFORM_BUFFER, BIND_WINDOWS, windows_.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, BIND_CASCADE_ENDS, range_.name());
}

void ShadowMap::build(const FrameInputs& in) {
  const float furthest = 1.0f;
  glViewport(0, 0, built_.resolution, built_.resolution);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  // Casters between the light and the window count: no near plane.
  glEnable(GL_DEPTH_CLAMP);
  for (int layer = 0; layer < layers_of(in.light); ++layer) {
    const GLuint framebuffer = framebuffers_[static_cast<size_t>(layer)].name();
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &furthest);
    if (!built_.fits_receivers() && fixed_.windows[static_cast<size_t>(layer)].guard.y == 0.0f) continue;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    for (const Drawn drawn : {Drawn::opaque, Drawn::masked}) {
      if (drawn == Drawn::masked && !in.masked_casters) continue;
      get(drawn == Drawn::masked ? ShadowMapProgram::build_masked : ShadowMapProgram::build).use();
      glUniform1i(0, layer);
      glUniform1f(1, margin());
      in.draw_casters(drawn);
    }
  }
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

void ShadowMap::visibility(const FrameInputs& in, Visibility& out, ShadowMapProgram program) {
  const gpu::Program& lookup = get(program);
  glBindTextureUnit(UNIT_DEPTH_MAP, map_.name());
  if (built_.filter == "pcf2x2") glBindSampler(UNIT_DEPTH_MAP, hardware_filter_.name());
  glBindImageTexture(IMAGE_MASK, out.mask.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_COUNTERS, counters_.name());
  lookup.use();
  glUniform1f(1, margin());
  glUniform4f(2, float(built_.bias_texels), float(built_.slope_bias()), float(built_.normal_offset_texels),
              built_.receiver_plane ? 1.0f : 0.0f);
  const std::vector<glm::vec2> taps = built_.tap_offsets();
  if (!taps.empty()) glUniform2fv(3, static_cast<GLsizei>(taps.size()), &taps[0].x);
  lookup.dispatch(in.width_px, in.height_px, 16, 16);
  glBindSampler(UNIT_DEPTH_MAP, 0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

Counts ShadowMap::count(const FrameInputs& in, Visibility& out, bool) {
  const gpu::Query passed("depth map fragments", GL_SAMPLES_PASSED);
  glBeginQuery(GL_SAMPLES_PASSED, passed.name());
  fit(in);
  build(in);
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint64 fragments = 0;
  glGetQueryObjectui64v(passed.name(), GL_QUERY_RESULT, &fragments);
  counters_.fill(0);
  visibility(in, out, ShadowMapProgram::visibility_counted);
  const shared::MapCounters counted = counters_.read<shared::MapCounters>(1)[0];
  return {{"fragments_in_map", fragments},
          {"lookups", counted.receivers},
          {"lookups_outside", counted.outside},
          {"comparisons", counted.comparisons}};
}

Counts ShadowMap::memory() const {
  return {{"depth map", map_.bytes()}, {"windows", windows_.bytes() + range_.bytes() + counters_.bytes()}};
}

gpu::Plan ShadowMap::memory_needed(const FrameShape& shape) const {
  using Kind = gpu::Planned::Kind;
  const ShadowMapSettings& s = settings_;
  return {gpu::planned_texture("depth map", GL_DEPTH_COMPONENT32F, s.resolution, s.resolution,
                               {"--resolution", "--cascades"}, s.cascades * shape.faces),
          gpu::planned_buffer("windows", Kind::other_buffer, windows_bytes, {}),
          gpu::planned_buffer("windows", Kind::other_buffer, sizeof(shared::CascadeRange), {}),
          gpu::planned_buffer("windows", Kind::storage_buffer, sizeof(shared::MapCounters), {})};
}

std::vector<float> ShadowMap::read_map() const {
  return map_.read<float>(GL_DEPTH_COMPONENT, GL_FLOAT, 1);
}

std::unique_ptr<Technique> make_shadow_map() {
  return std::make_unique<ShadowMap>();
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "frame/gbuffer.h"

#include "frame/spine.h"
#include "shared/bindings.h"

namespace izb {

GBuffer::GBuffer(int width_px, int height_px, bool micro_quads)
    : depth("depth", GL_DEPTH_COMPONENT32F, width_px, height_px),
      id("id", GL_RG32UI, width_px, height_px),
      eye_distance("eye distance", GL_R32F, width_px, height_px),
      normal("normal", GL_RG32F, width_px, height_px),
      shading_normal("shading normal", GL_RG16, width_px, height_px),
      micro_quad(micro_quads ? gpu::Texture("micro-quads", GL_RGBA32F, width_px, height_px) : gpu::Texture()),
      albedo("albedo", GL_SRGB8_ALPHA8, width_px, height_px) {}

void GBuffer::bind() const {
  glBindTextureUnit(UNIT_ID, id.name());
  glBindTextureUnit(UNIT_EYE_DISTANCE, eye_distance.name());
  glBindTextureUnit(UNIT_NORMAL, normal.name());
  glBindTextureUnit(UNIT_SHADING_NORMAL, shading_normal.name());
  if (micro_quad) glBindTextureUnit(UNIT_MICRO_QUAD, micro_quad.name());
  glBindTextureUnit(UNIT_ALBEDO, albedo.name());
}

size_t GBuffer::bytes() const {
  return depth.bytes() + id.bytes() + eye_distance.bytes() + normal.bytes() + shading_normal.bytes() +
         micro_quad.bytes() + albedo.bytes();
}

gpu::Plan GBuffer::memory_needed(int width_px, int height_px, bool micro_quads) {
  gpu::Plan plan;
  const auto add = [&](const char* part, GLenum format) {
    plan.push_back(gpu::planned_texture(part, format, width_px, height_px, {"--size"}));
  };
  add("depth", GL_DEPTH_COMPONENT32F);
  add("id", GL_RG32UI);
  add("eye distance", GL_R32F);
  add("normal", GL_RG32F);
  add("shading normal", GL_RG16);
  if (micro_quads) add("micro-quads", GL_RGBA32F);
  add("albedo", GL_SRGB8_ALPHA8);
  return plan;
}

namespace {

gpu::ProgramSpec resolve_spec(bool micro_quads, gpu::Defines defines) {
  if (micro_quads) defines["MICRO_QUAD"] = "1";
  return {"gbuffer resolve", {"frame/1_gbuffer_resolve.comp.glsl"}, defines};
}

gpu::ProgramSpec lift_spec() {
  return {"gbuffer lift", {"frame/1_gbuffer_lift.comp.glsl"}, {}};
}

gpu::ProgramSpec masked_spec(gpu::Defines defines) {
  defines["MASKED"] = "1";
  return {"gbuffer masked", {"frame/1_gbuffer.vert.glsl", "frame/1_gbuffer.frag.glsl"}, defines};
}

}  // namespace

std::vector<gpu::ProgramSpec> GBufferStage::program_specs() {
  const gpu::Defines windows{{"POSITION_WINDOWS", "3"}, {"INDEX_WINDOWS", "2"}, {"WINDOW_WORDS", "192u"}};
  return {{"gbuffer", {"frame/1_gbuffer.vert.glsl", "frame/1_gbuffer.frag.glsl"}, {}},
          resolve_spec(false, {}),
          resolve_spec(true, {}),
          resolve_spec(true, windows),
          lift_spec(),
          masked_spec({}),
          masked_spec(windows)};
}

GBufferStage::GBufferStage() : draw_(program_specs()[0]) {}

void GBufferStage::resize(int width_px, int height_px, const SamplePattern& samples, const SceneBuffers& scene) {
  const bool micro_quads = samples.count() > 1;
  lifted_ = micro_quads && samples.lifted;
  if (lifted_) lift_.become(lift_spec());
  const gpu::Defines geometry = scene.windows().defines();
  resolve_.become(resolve_spec(micro_quads, geometry));
  if (has_masked(scene.draw_list())) draw_masked_.become(masked_spec(geometry));
  if (gbuffer_.id.width_px() == width_px && gbuffer_.id.height_px() == height_px &&
      static_cast<bool>(gbuffer_.micro_quad) == micro_quads)
    return;
  gbuffer_ = GBuffer(width_px, height_px, micro_quads);
  framebuffer_ =
      gpu::Framebuffer("gbuffer", {&gbuffer_.id, &gbuffer_.albedo, &gbuffer_.shading_normal}, &gbuffer_.depth);
}

void GBufferStage::render(const SceneBuffers& scene, gpu::StageTimers& timers) {
  const gpu::StageTimers::Scope scope(timers, name(Stage::gbuffer));
  const int width_px = gbuffer_.id.width_px(), height_px = gbuffer_.id.height_px();
  const GLuint no_id[4] = {0, 0, 0, 0};
  const float black[4] = {0.0f, 0.0f, 0.0f, 0.0f}, furthest = 0.0f;  // reversed depth
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferuiv(framebuffer_.name(), GL_COLOR, 0, no_id);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 1, black);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 2, black);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &furthest);

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_px, height_px);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_FRAMEBUFFER_SRGB);
  draw_.use();
  scene.draw_with_textures(Drawn::opaque);
  if (has_masked(scene.draw_list())) {
    draw_masked_.use();
    scene.draw_with_textures(Drawn::masked);
  }
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DEPTH_TEST);

  gbuffer_.bind();
  glBindImageTexture(IMAGE_EYE_DISTANCE, gbuffer_.eye_distance.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  glBindImageTexture(IMAGE_NORMAL, gbuffer_.normal.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  if (gbuffer_.micro_quad)
    glBindImageTexture(IMAGE_MICRO_QUAD, gbuffer_.micro_quad.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  resolve_.dispatch(width_px, height_px, 16, 16);
  if (lifted_) {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glBindImageTexture(IMAGE_MICRO_QUAD, gbuffer_.micro_quad.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    lift_.dispatch(width_px, height_px, 16, 16);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "frame/shade.h"

#include "frame/spine.h"
#include "shared/bindings.h"

namespace izb {

std::vector<gpu::ProgramSpec> ShadeStage::program_specs() {
  return {{"shade", {"frame/6_shade.comp.glsl"}, {}}};
}

ShadeStage::ShadeStage() : program_(program_specs()[0]) {}

void ShadeStage::resize(int width_px, int height_px) {
  picture_ = gpu::Texture("picture", GL_RGBA16F, width_px, height_px);
}

gpu::Plan ShadeStage::memory_needed(int width_px, int height_px) {
  return {gpu::planned_texture("picture", GL_RGBA16F, width_px, height_px, {"--size"})};
}

void ShadeStage::render(const gpu::Texture& mask, gpu::StageTimers& timers) {
  const gpu::StageTimers::Scope scope(timers, name(Stage::shade));
  glBindTextureUnit(UNIT_MASK, mask.name());
  glBindImageTexture(IMAGE_PICTURE, picture_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
  program_.dispatch(picture_.width_px(), picture_.height_px(), 16, 16);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "frame/shade.h"

#include "shared/bindings.h"

namespace izb {

std::vector<gpu::ProgramSpec> ShadeStage::program_specs() {
  return {{"shade", {"frame/6_shade.comp.glsl"}, {}},
          {"shade meter", {"frame/6_shade_meter.comp.glsl"}, {}},
          {"shade expose", {"frame/6_shade_expose.comp.glsl"}, {}}};
}

ShadeStage::ShadeStage()
    : program_(program_specs()[0]),
      meter_(program_specs()[1]),
      expose_(program_specs()[2]),
      meter_points_("shade meter", sizeof(float) * shared::meter_side * shared::meter_side),
      exposure_("shade exposure", sizeof(shared::Exposure)) {}

void ShadeStage::resize(int width_px, int height_px) {
  picture_.become("picture", GL_RGBA16F, width_px, height_px);
}

gpu::Plan ShadeStage::memory_needed(int width_px, int height_px) {
  return {gpu::planned_texture("picture", GL_RGBA16F, width_px, height_px, {"--size"})};
}

void ShadeStage::begin(float exposure) {
  const shared::Exposure given{glm::vec4(exposure)};
  exposure_.update(0, sizeof given, &given);
  meter_points_.fill(0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_METER, meter_points_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_EXPOSED, exposure_.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, BIND_EXPOSURE, exposure_.name());
}

void ShadeStage::measure() {
  meter_.dispatch(shared::meter_side, shared::meter_side, 16, 16);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ShadeStage::expose() {
  expose_.dispatch(shared::meter_side, 1, shared::meter_side, 1);
  glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ShadeStage::add(const gpu::Texture& mask, bool first) {
  glBindTextureUnit(UNIT_MASK, mask.name());
  glBindImageTexture(IMAGE_PICTURE, picture_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA16F);
  program_.use();
  glUniform1i(0, first);
  program_.dispatch(picture_.width_px(), picture_.height_px(), 16, 16);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "shadow/izb/hardware_raster.h"

#include <cmath>

#include "base/error.h"
#include "gpu/gl.h"
#include "shared/footprint.h"

namespace izb {
namespace {

/// Left for vertex snapping and all guards; a triangle that needs more is left to the geometry shader.
constexpr float reserve = 0.0625f;
/// Without dilation: a texel's square touches one of four copies shifted by this if, grown by it, it touches the
/// triangle.
constexpr float shift = 0.25f;

bool dilates(const gpu::Capabilities& c) {
  return c.raster_dilation_px > 0.0f;
}

/// By how much the triangles must be dilated beyond a texel's own square, in steps that the driver has.
float dilation(const gpu::Capabilities& c, double dilation_texels) {
  if (!dilates(c)) return shift;
  const float least = static_cast<float>(dilation_texels) - 0.5f + reserve, step = c.raster_dilation_step_px;
  return step > 0.0f ? std::ceil(least / step) * step : least;
}

}  // namespace

std::string HardwareRaster::missing(const gpu::Capabilities& c, double dilation_texels) {
  std::vector<std::string> lacking;
  for (const char* name : {"GL_NV_conservative_raster", "GL_NV_geometry_shader_passthrough"})
    if (!c.has(name)) lacking.emplace_back(name);
  if (!lacking.empty())
    return fmt::format("--raster hw needs {}, which this driver lacks", fmt::join(lacking, " and "));
  const float most = dilates(c) ? c.raster_dilation_px : shift;
  if (dilates(c) ? dilation(c, dilation_texels) > most : dilation_texels - 0.5 + reserve > most)
    return fmt::format(
        "--raster hw dilates triangles by at most {} texels {} GL_NV_conservative_raster_dilate here: take a "
        "smaller --dilation than {}",
        0.5f + most - reserve, dilates(c) ? "with" : "without", dilation_texels);
  return "";
}

HardwareRaster::HardwareRaster(const gpu::Capabilities& c, double dilation_texels)
    : dilation_(dilation(c, dilation_texels)), shifts_{glm::vec2(0.0f)} {
  if (!dilates(c)) shifts_ = {{-shift, -shift}, {shift, -shift}, {-shift, shift}, {shift, shift}};
}

void HardwareRaster::begin() const {
  glEnable(GL_CONSERVATIVE_RASTERIZATION_NV);
  if (shifts_.size() == 1) glConservativeRasterParameterfNV(GL_CONSERVATIVE_RASTER_DILATE_NV, dilation_);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(shared::hardware_offset_factor(square()), 0.0f);
}

void HardwareRaster::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CONSERVATIVE_RASTERIZATION_NV);
}

}  // namespace izb

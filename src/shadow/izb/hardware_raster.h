// SPDX-License-Identifier: MIT
// The rasteriser's own conservative mode in place of the geometry shader's footprints (--raster hw):
// NV_conservative_raster, dilated by NV_conservative_raster_dilate, or else by drawing four times.
#pragma once
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/capabilities.h"

namespace izb {

class HardwareRaster {
 public:
  /// What the driver lacks to dilate triangles by so many texels; "": nothing.
  static std::string missing(const gpu::Capabilities& capabilities, double dilation_texels);

  HardwareRaster() = default;
  HardwareRaster(const gpu::Capabilities& capabilities, double dilation_texels);

  /// Half the side of the square that draws swept over all triangles sweep, in texels.
  float square() const { return 0.5f + dilation_; }
  /// The casters are drawn once for each, shifted by so many texels.
  const std::vector<glm::vec2>& shifts() const { return shifts_; }
  /// Around the draws. Depths are lowered to what early z may rely on.
  void begin() const;
  void end() const;

 private:
  float dilation_ = 0.0f;  ///< beyond a texel's own square
  std::vector<glm::vec2> shifts_;
};

}  // namespace izb

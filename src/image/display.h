// SPDX-License-Identifier: MIT
// What a display shows of an image: where perceptual metrics begin.
#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "image/image.h"

namespace izb {

/// sRGB code values in [0, 1], not rounded to 8 bits; rows from top to bottom.
struct DisplayImage {
  int width_px = 0, height_px = 0;
  std::array<std::vector<float>, 3> rgb;
};

/// An image from a file, and what its colours are.
struct StoredImage {
  Image image;
  bool linear = true;  ///< R, G and B are linear light; otherwise they are sRGB code values
};

/// Reads OpenEXR (linear light, see read_exr) or PNG (channels R, G, B and, if there, A: the 8-bit codes divided by
/// 255), whatever the file's name. Throws izb::Error if it is neither or a device, or as read_exr and read_png do.
StoredImage read_image(const std::filesystem::path& path);

/// The channels R, G and B on a display: linear light is multiplied by 2^exposure_stops, clamped to [0, 1] and encoded;
/// code values are taken as they are. Throws izb::Error if a channel is missing or holds no floats.
DisplayImage to_display(const StoredImage& stored, double exposure_stops = 0.0);

}  // namespace izb

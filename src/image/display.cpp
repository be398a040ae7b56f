// SPDX-License-Identifier: MIT
#include "image/display.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/srgb.h"

namespace izb {
namespace {

constexpr const char* component_names[] = {"R", "G", "B", "A"};
constexpr unsigned char exr_magic[] = {0x76, 0x2F, 0x31, 0x01}, png_magic[] = {0x89, 'P', 'N', 'G'};

Image as_image(const Image8& picture) {
  Image image;
  image.width_px = picture.width_px, image.height_px = picture.height_px;
  const auto components = size_t(picture.components);
  for (size_t c = 0; c < components; ++c) {
    std::vector<float>& values = image.add_float(component_names[c]);
    for (size_t i = 0; i < values.size(); ++i) values[i] = float(picture.pixels[components * i + c]) / 255.0f;
  }
  return image;
}

}  // namespace

StoredImage read_image(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_binary_file(path);
  const auto begins_with = [&](std::span<const unsigned char> magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  };
  if (begins_with(exr_magic)) return {read_exr(bytes, path.string()), true};
  if (begins_with(png_magic)) return {as_image(read_png(bytes, path.string())), false};
  fail("cannot read '{}': it is neither OpenEXR nor PNG", path.string());
}

DisplayImage to_display(const StoredImage& stored, double exposure_stops) {
  DisplayImage display{stored.image.width_px, stored.image.height_px, {}};
  const auto scale = float(std::exp2(exposure_stops));
  for (size_t c = 0; c < 3; ++c) {
    display.rgb[c] = stored.image.floats(component_names[c]);
    if (!stored.linear) continue;
    for (float& value : display.rgb[c]) value = float(linear_to_srgb(double(clamp_to_display(scale * value))));
  }
  return display;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "image/png.h"

#include <png.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"

namespace izb {
namespace {

/// libpng's state for one picture, freed on every way out.
struct PngImage {
  png_image state{};
  PngImage() { state.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&state); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

void write_png(const std::filesystem::path& path, const Image8& picture) {
  AtomicFile file(path);
  write_png(file, picture);
  file.commit();
}

void write_png(AtomicFile& file, const Image8& picture) {
  if (picture.pixels.size() != size_t(picture.width_px) * size_t(picture.height_px) * size_t(picture.components)) {
    throw std::logic_error("a picture has the wrong number of pixels");
  }
  PngImage png;
  png.state.width = png_uint_32(picture.width_px);
  png.state.height = png_uint_32(picture.height_px);
  png.state.format = picture.components == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.state);
  std::vector<std::byte> bytes(size);
  if (!png_image_write_to_memory(&png.state, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr)) {
    fail("cannot write '{}': libpng says: {}", file.target().string(), png.state.message);
  }
  file.write(std::span(bytes).first(size));
}

Image8 read_png(const std::filesystem::path& path) {
  return read_png(read_binary_file(path), path.string());
}

Image8 read_png(std::span<const std::byte> bytes, const std::string& name) {
  PngImage png;
  if (!png_image_begin_read_from_memory(&png.state, bytes.data(), bytes.size())) {
    fail("cannot read '{}' as PNG: {}", name, png.state.message);
  }
  Image8 picture;
  picture.width_px = int(png.state.width), picture.height_px = int(png.state.height);
  picture.components = png.state.format & PNG_FORMAT_FLAG_ALPHA ? 4 : 3;
  const size_t size = size_t(picture.width_px) * size_t(picture.height_px) * size_t(picture.components);
  if (size > std::numeric_limits<uint32_t>::max()) {
    fail("cannot read '{}' as PNG: its size, {} x {} pixels, is too large", name, picture.width_px, picture.height_px);
  }
  png.state.format = picture.components == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  picture.pixels.resize(size);
  if (!png_image_finish_read(&png.state, nullptr, picture.pixels.data(), 0, nullptr)) {
    fail("cannot read '{}' as PNG: {}", name, png.state.message);
  }
  return picture;
}

}  // namespace izb

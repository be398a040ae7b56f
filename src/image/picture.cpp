// SPDX-License-Identifier: MIT
#include "image/picture.h"

#include <algorithm>
#include <stdexcept>

#include "image/srgb.h"

namespace izb {
namespace {

template <typename T>
std::vector<T> part_of(const std::vector<T>& values, int width_px, const PixelRect& part) {
  std::vector<T> out;
  out.reserve(size_t(part.width) * size_t(part.height));
  for (int y = part.y; y < part.y + part.height; ++y) {
    const auto first = values.begin() + ptrdiff_t(y) * width_px + part.x;
    out.insert(out.end(), first, first + part.width);
  }
  return out;
}

}  // namespace

Image crop(const Image& image, const PixelRect& part) {
  if (part.x < 0 || part.y < 0 || part.width < 1 || part.height < 1 || part.width > image.width_px - part.x ||
      part.height > image.height_px - part.y)
    throw std::logic_error("a crop lies outside its image");
  Image out;
  out.width_px = part.width, out.height_px = part.height;
  for (const Channel& channel : image.channels)
    std::visit([&](const auto& values) { out.add(channel.name, part_of(values, image.width_px, part)); }, channel.data);
  return out;
}

Image box_filter(const Image& image, int factor) {
  if (factor < 1 || image.width_px % factor != 0 || image.height_px % factor != 0)
    throw std::logic_error("a box filter's factor does not divide the image's sides");
  Image out;
  out.width_px = image.width_px / factor, out.height_px = image.height_px / factor;
  for (const Channel& channel : image.channels) {
    const auto* values = std::get_if<std::vector<float>>(&channel.data);
    if (!values) continue;
    std::vector<double> sums(out.pixel_count());
    for (int y = 0; y < image.height_px; ++y)
      for (int x = 0; x < image.width_px; ++x)
        sums[size_t(y / factor) * size_t(out.width_px) + size_t(x / factor)] +=
            (*values)[size_t(y) * size_t(image.width_px) + size_t(x)];
    std::vector<float>& means = out.add_float(channel.name);
    std::transform(sums.begin(), sums.end(), means.begin(),
                   [&](double sum) { return static_cast<float>(sum / (double(factor) * factor)); });
  }
  return out;
}

Image8 preview(const Image& image) {
  Image8 out;
  out.width_px = image.width_px;
  out.height_px = image.height_px;
  out.pixels.resize(image.pixel_count() * 3);
  const std::vector<float>* planes[] = {&image.floats("R"), &image.floats("G"), &image.floats("B")};
  for (size_t i = 0; i < image.pixel_count(); ++i)
    for (size_t c = 0; c < 3; ++c) out.pixels[3 * i + c] = to_srgb8((*planes[c])[i]);
  return out;
}

Image8 magnify(const Image8& picture, int factor) {
  if (factor < 1) throw std::logic_error("a picture cannot be magnified by less than 1");
  Image8 out{picture.width_px * factor, picture.height_px * factor, picture.components, {}};
  const auto components = size_t(picture.components);
  out.pixels.reserve(size_t(out.width_px) * size_t(out.height_px) * components);
  for (int y = 0; y < out.height_px; ++y)
    for (int x = 0; x < out.width_px; ++x) {
      const size_t from = (size_t(y / factor) * size_t(picture.width_px) + size_t(x / factor)) * components;
      const auto pixel = picture.pixels.begin() + ptrdiff_t(from);
      out.pixels.insert(out.pixels.end(), pixel, pixel + picture.components);
    }
  return out;
}

Image8 side_by_side(std::span<const Image8> pictures, int gap_px, const std::array<uint8_t, 3>& gap_color) {
  if (pictures.empty() || gap_px < 0) throw std::logic_error("nothing to put side by side");
  Image8 out{-gap_px, pictures.front().height_px, 3, {}};
  for (const Image8& picture : pictures) {
    if (picture.height_px != out.height_px || picture.components != 3)
      throw std::logic_error("pictures side by side differ in height or have alpha");
    out.width_px += gap_px + picture.width_px;
  }
  out.pixels.reserve(3 * size_t(out.width_px) * size_t(out.height_px));
  for (int y = 0; y < out.height_px; ++y)
    for (const Image8& picture : pictures) {
      if (&picture != &pictures.front())
        for (int x = 0; x < gap_px; ++x) out.pixels.insert(out.pixels.end(), gap_color.begin(), gap_color.end());
      const ptrdiff_t row = 3 * ptrdiff_t(picture.width_px);
      const auto first = picture.pixels.begin() + y * row;
      out.pixels.insert(out.pixels.end(), first, first + row);
    }
  return out;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// The same pixels of several frames, magnified and side by side: what bench/crops.sh and
// bench/figure_1.sh show of their frames.
#include <CLI/CLI.hpp>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb {
namespace {

struct CropOptions {
  std::vector<std::string> frames;
  std::string output;
  std::vector<int> rect;
  int magnification = 4;
};

/// The crop of one frame; the first frame's size counts for all, a larger frame is box-filtered down to it.
Image crop_of(const std::string& file, const PixelRect& part, std::optional<std::pair<int, int>>& size) {
  const Image frame = read_exr(file);
  if (!size) size = {frame.width_px, frame.height_px};
  const auto [width, height] = *size;
  const int factor = frame.width_px / width;
  if (factor < 1 || factor * width != frame.width_px || factor * height != frame.height_px)
    fail("'{}' has {} x {} pixels: not {} x {} times a whole number", file, frame.width_px, frame.height_px, width,
         height);
  if (part.width > width - part.x || part.height > height - part.y) fail("the crop does not lie within '{}'", file);
  const Image all = crop(frame, {part.x * factor, part.y * factor, part.width * factor, part.height * factor});
  return factor == 1 ? all : box_filter(all, factor);
}

void print_difference(const std::string& file, const Image& image, const std::string& other_file, const Image& other) {
  if (!image.find("mask") || !other.find("mask")) return;  // filtered: it has none
  const std::vector<uint32_t>&a = image.uints("mask"), &b = other.uints("mask");
  // Where a technique filters, only the number of a pixel's bits means something.
  int differing = 0, more = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    differing += std::popcount(a[i] ^ b[i]);
    more += std::abs(std::popcount(a[i]) - std::popcount(b[i]));
  }
  fmt::print("{} and {}: {} of {} mask bits of the crop differ, the shadow of a pixel by {:.2f} %\n", file, other_file,
             differing, 32 * a.size(), 100.0 * more / (32.0 * double(a.size())));
}

void run(const CropOptions& o) {
  const PixelRect part{o.rect[0], o.rect[1], o.rect[2], o.rect[3]};
  std::optional<std::pair<int, int>> size;
  std::vector<Image8> panels;
  Image last;
  for (size_t i = 0; i < o.frames.size(); ++i) {
    Image image = crop_of(o.frames[i], part, size);
    if (i > 0) print_difference(o.frames[i - 1], last, o.frames[i], image);
    panels.push_back(magnify(preview(image), o.magnification));
    last = std::move(image);
  }
  if (o.output.empty()) return;
  write_png(o.output, side_by_side(panels, 2 * o.magnification, {255, 255, 255}));
  fmt::print("wrote {}\n", o.output);
}

int run_from_command_line(int argc, char** argv) {
  CropOptions o;
  CLI::App app("The same pixels of several OpenEXR frames of izb, magnified and side by side, as PNG");
  app.add_option("FRAME", o.frames, "the frames, from left to right; one larger than the first is box-filtered")
      ->required();
  app.add_option("-o,--output", o.output, "the picture; without it, only bits are counted")->type_name("FILE");
  app.add_option("--crop", o.rect, "the pixels, from the top left, as the first frame counts them")
      ->type_name("X,Y,WIDTH,HEIGHT")
      ->delimiter(',')
      ->expected(4)
      ->required()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--magnify", o.magnification, "by how much (1 to 64; default 4)")->check(CLI::Range(1, 64));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (o.rect[2] == 0 || o.rect[3] == 0) {
    fmt::print(stderr, "izb_crops: the crop is empty\n");
    return 2;
  }
  try {
    run(o);
  } catch (const std::exception& error) {
    fmt::print(stderr, "izb_crops: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace izb

int main(int argc, char** argv) {
  return izb::run_from_command_line(argc, argv);
}

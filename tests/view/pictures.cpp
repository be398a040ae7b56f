// SPDX-License-Identifier: MIT
// The pictures of docs/VIEW.md and the README: the viewer on the shipped scene, in a window as a person has it.
#include <cstdio>
#include <filesystem>

#include "image/picture.h"
#include "image/png.h"
#include "view/viewer.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

constexpr int width_px = 1120;
constexpr const char* size = "1120x630";

/// Each pixel the mean of factor x factor.
Image8 smaller(const Image8& image, int factor) {
  Image8 out;
  out.width_px = image.width_px / factor, out.height_px = image.height_px / factor;
  for (int y = 0; y < out.height_px; ++y)
    for (int x = 0; x < out.width_px; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < factor * factor; ++k)
          sum += image.pixels[3 * (size_t(y * factor + k / factor) * size_t(image.width_px) +
                                   size_t(x * factor + k % factor)) +
                              size_t(c)];
        out.pixels.push_back(static_cast<uint8_t>(sum / (factor * factor)));
      }
  return out;
}

/// Rows of four.
Image8 sheet(const std::vector<Image8>& pictures) {
  constexpr int columns = 4, gap_px = 4;
  Image8 out;
  for (size_t first = 0; first < pictures.size(); first += columns) {
    std::vector<Image8> row(pictures.begin() + std::ptrdiff_t(first),
                            pictures.begin() + std::ptrdiff_t(std::min(first + columns, pictures.size())));
    while (row.size() < columns) {
      row.push_back(row.front());
      std::fill(row.back().pixels.begin(), row.back().pixels.end(), uint8_t{255});
    }
    const Image8 line = side_by_side(row, gap_px, {255, 255, 255});
    if (out.width_px == line.width_px) out.pixels.insert(out.pixels.end(), size_t(3 * gap_px * line.width_px), 255);
    out.height_px += (out.width_px == 0 ? 0 : gap_px) + line.height_px;
    out.width_px = line.width_px;
    out.pixels.insert(out.pixels.end(), line.pixels.begin(), line.pixels.end());
  }
  return out;
}

class Pictures {
 public:
  explicit Pictures(const fs::path& folder)
      : folder_(folder),
        home_(fs::temp_directory_path() / ("izb_pictures_" + std::to_string(getpid()))),
        viewer_(display_, options()) {
    viewer_.wait_at_rest(300.0);
    if (viewer_.has_widget("close hints")) display_.click(viewer_.widget("close hints"));
  }
  ~Pictures() { fs::remove_all(home_); }

  void make() {
    compare();
    stages();
    light_space();
    viewer_.stop();
  }

 private:
  ViewerOptions options() {
    fs::create_directories(home_);
    ViewerOptions options;
    options.home = home_;
    for (const char* word : {IZB_PROGRAM, "view", IZB_GARDEN, "--cascades", "4", "--size", size, "--folder"})
      options.words.emplace_back(word);
    options.words.push_back(home_);
    return options;
  }
  void press(const char* key) {
    viewer_.input().key(key);
    viewer_.wait_at_rest(300.0);
  }
  std::string look() { return viewer_.state().at("look").get<std::string>(); }
  void write(const char* name, const Image8& picture) {
    write_png(folder_ / name, picture);
    std::printf("wrote %s\n", (folder_ / name).c_str());
  }

  /// 32 samples beside one, and through the lens the samples of each pixel.
  void compare() {
    press("c");
    viewer_.input().drag({width_px / 2, 200}, {690, 200});
    display_.key("z");
    viewer_.input().move({560, 560});
    display_.move({545, 548});
    display_.scroll(1);
    display_.scroll(1);
    viewer_.wait_at_rest(300.0);
    write("view_compare.png", viewer_.still_capture());
    display_.key("z");
    for (int i = 0; i < 3; ++i) press("c");
  }

  void stages() {
    press("Tab");
    display_.move({5, 5});
    std::vector<Image8> all;
    for (;;) {
      press("v");
      if (look().empty()) break;
      all.push_back(smaller(viewer_.still_capture(), 4));
    }
    write("view_stages.png", sheet(all));
    press("Tab");
  }

  /// The lists of a pixel, on the grid.
  void light_space() {
    while (look() != "grid-lists") press("v");
    viewer_.input().click({480, 560});
    viewer_.wait_for("picked", {}, 300.0);
    viewer_.wait_at_rest(300.0);
    write("view_light_space.png", viewer_.still_capture());
  }

  const fs::path folder_, home_;
  XDisplay display_;
  Viewer viewer_;
};

}  // namespace
}  // namespace izb::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: view_pictures FOLDER\n", stderr);
    return 2;
  }
  try {
    izb::test::Pictures(argv[1]).make();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "view_pictures: %s\n", e.what());
    return 1;
  }
}

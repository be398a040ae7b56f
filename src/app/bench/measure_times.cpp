// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "app/bench/measure_parts.h"
#include "app/peer.h"
#include "app/results.h"
#include "base/progress.h"
#include "frame/read_back.h"
#include "image/heat_map.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb::bench {
namespace {

Subject* first_working(Subjects& subjects) {
  for (Subject& s : subjects.all())
    if (s.works()) return &s;
  return nullptr;
}

/// What nineteen of twenty pixels do not exceed: a scale that single pixels do not stretch.
float scale_of(std::vector<float> values) {
  std::erase(values, 0.0f);
  if (values.empty()) return 1.0f;
  const auto at = values.begin() + long(values.size() * 95 / 100);
  std::nth_element(values.begin(), at, values.end());
  return std::max(1.0f, *at);
}

/// A report holds many pictures: each is reduced by a whole number, to no less than this.
int reduction(const Size& size) {
  constexpr int least_width_px = 640;
  for (int factor = size.width_px / least_width_px; factor > 1; --factor)
    if (size.width_px % factor == 0 && size.height_px % factor == 0) return factor;
  return 1;
}

nlohmann::json pictures_of(const Job& job, Subjects& subjects, Subject& s, const std::filesystem::path& folder) {
  const Size size = s.frame.size;
  const int factor = reduction(size);
  std::vector<nlohmann::json> files;
  const auto add = [&](const std::string& word, const std::string& label, const Image8& picture) {
    const std::string name = fmt::format("images/{}-{}-{}.png", job.experiment, file_word(job.scene.name), word);
    write_png(folder / name, picture);
    files.push_back({{"file", name}, {"label", label}});
  };
  add("picture", "picture", preview(box_filter(frame_image(subjects.rendered(s), nlohmann::json::object()), factor)));
  const auto add_map = [&](const std::string& word, const std::string& label, std::vector<float> values) {
    if (values.empty()) return;
    values = flip_rows(std::move(values), size.width_px, size.height_px);
    Image image;
    image.width_px = size.width_px, image.height_px = size.height_px;
    image.add("value", std::move(values));
    image = box_filter(image, factor);
    const std::vector<float>& means = image.floats("value");
    const float most = scale_of(means);
    add(word, fmt::format("{} (bright: {:.0f} and more)", label, most),
        heat_map(means, image.width_px, image.height_px, most));
  };
  add_map("tests", "tests a pixel", s.renderer->tests_a_pixel());
  add_map("lists", "length of the longest list", s.renderer->list_lengths());
  return {{"title", job.scene.name + ", " + s.configuration.name}, {"files", files}};
}

}  // namespace

void measure_times(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result) {
  subjects.round(false);
  std::unique_ptr<Peer> peer;
  Subject* const first = first_working(subjects);
  if (first && job.settings.value("peer", false) && reference::embree_available())
    peer = std::make_unique<Peer>(*first->renderer, true);
  Progress progress(job.experiment + " " + job.scene.name, uint64_t(job.frames));
  for (int i = 0; i < job.frames; ++i) {
    subjects.round(true);
    if (peer) peer->run();
    progress.advance();
  }
  if (peer) result["peer"] = peer->to_json();
  result["configurations"] = subjects.results(true);
  if (first && first->works() && job.settings.value("pictures", false))
    result["pictures"] = pictures_of(job, subjects, *first, folder);
}

void measure_animation(const Job& job, Subjects& subjects, const std::filesystem::path&, nlohmann::json& result) {
  const double fps = job.settings.value("fps", 30.0), first_s = job.settings.value("first_s", 0.0);
  if (subjects.session().plays) {
    subjects.move_to(first_s);
    subjects.round(false);
  } else {
    for (Subject& s : subjects.all())
      if (s.works()) s.failed = "the scene has no animation", s.inapplicable = true;
  }
  Progress progress(job.experiment + " " + job.scene.name, uint64_t(job.frames));
  for (int i = 0; i < job.frames && subjects.session().plays; ++i) {
    subjects.move_to(first_s + i / fps);
    subjects.round(true);
    progress.advance();
  }
  result["configurations"] = subjects.results(true);
  result["fps"] = fps;
  result["first_s"] = first_s;
}

}  // namespace izb::bench

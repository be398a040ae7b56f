// SPDX-License-Identifier: MIT
#include "app/bench/truth_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/json_text.h"
#include "base/sha256.h"
#include "base/version.h"
#include "image/exr.h"
#include "image/picture.h"

namespace izb::bench {

namespace {

/// The truth's frames are so many times as wide and high, and box-filtered: a frame's vertices then serve 64 rays a
/// pixel, or 16 where that picture would be large or the rays too few.
int truth_scale(const Job& job) {
  const Size size = parse_size(job.size);
  return truth_rays(job) % 64 == 0 && 8 * std::max(size.width_px, size.height_px) <= 4096 ? 8 : 4;
}

Size truth_size(const Job& job) {
  const Size size = parse_size(job.size);
  return {truth_scale(job) * size.width_px, truth_scale(job) * size.height_px};
}

}  // namespace

int truth_rays(const Job& job) {
  return job.settings.value("truth_rays", 0);
}

std::filesystem::path truth_path(const Job& job, const std::filesystem::path& folder) {
  // Which scene, seen from where, by which driver: one of another file, or of another camera, is another's.
  Job what;
  what.scene = job.scene, what.context = job.context;
  const std::string text = json_text(to_json(what));
  const std::string digest = sha256_hex(std::as_bytes(std::span(text))).substr(0, 8);
  return folder / "truth" /
         fmt::format("{}-{}-{}-{}-{}.exr", file_word(job.scene.name), job.size, truth_rays(job), digest, commit());
}

std::vector<std::string> truth_command(const Job& job, const std::filesystem::path& folder) {
  const Size size = truth_size(job);
  const int frames = truth_rays(job) / (truth_scale(job) * truth_scale(job));
  std::vector<std::string> words{"render",
                                 job.scene.file,
                                 "--technique",
                                 "ray_traced",
                                 "--spp",
                                 "1",
                                 "-o",
                                 truth_path(job, folder).string(),
                                 "--resume",
                                 "on",
                                 "--size",
                                 fmt::format("{}x{}", size.width_px, size.height_px),
                                 "--supersample",
                                 std::to_string(frames),
                                 "--context",
                                 job.context};
  for (const auto& [option, value] : job.scene.frame) {
    words.push_back("--" + option);
    words.push_back(value);
  }
  return words;
}

Truth read_truth(const Job& job, const std::filesystem::path& folder) {
  const std::filesystem::path path = truth_path(job, folder);
  const Image large = read_exr(path);
  const Size size = truth_size(job);
  if (large.width_px != size.width_px || large.height_px != size.height_px)
    fail("'{}' has {} x {} pixels, not {} x {}", path.string(), large.width_px, large.height_px, size.width_px,
         size.height_px);
  const Image image = box_filter(large, truth_scale(job));
  Truth truth;
  truth.width_px = image.width_px, truth.height_px = image.height_px, truth.rays = truth_rays(job);
  truth.surface = image.floats("surface");
  truth.receiver = image.floats("receiver");
  truth.lit = image.floats("lit");
  const char* names[] = {"R", "G", "B"};
  for (int i = 0; i < 3; ++i) truth.rgb[i] = image.floats(names[i]);
  return truth;
}

}  // namespace izb::bench

// SPDX-License-Identifier: MIT
// Every technique on one frame against the supersampled truth: error and time.
#include <fmt/format.h>
#include <algorithm>
#include <bit>

#include <cmath>

#include "app/bench/lit_share.h"
#include "app/bench/measure_parts.h"
#include "app/bench/truth_file.h"
#include "frame/read_back.h"
#include "image/display.h"
#include "image/flip.h"
#include "image/heat_map.h"
#include "image/mask_metrics.h"
#include "image/metrics.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb::bench {
namespace {

using nlohmann::json;

/// A pixel whose every ray sees what could be lit: there the truth differs by shadow alone.
bool is_inner(const Truth& truth, size_t i) {
  return truth.receiver[i] >= 1.0f;
}

/// Errors of the share of light over some pixels.
struct Errors {
  uint64_t pixels = 0, far = 0;
  double sum = 0.0, squares = 0.0, leaks = 0.0, false_shadow = 0.0;

  void add(float error) {
    ++pixels;
    sum += std::abs(error), squares += double(error) * error;
    (error > 0.0f ? leaks : false_shadow) += std::abs(error);
    far += std::abs(error) > 1.0f / 8.0f;
  }
  json to_json() const {
    const double n = std::max<double>(1.0, double(pixels));
    return {{"pixels", pixels},
            {"mean", sum / n},
            {"rmse", std::sqrt(squares / n)},
            {"leaks", leaks / n},
            {"false_shadow", false_shadow / n},
            {"pixels_above_an_eighth", double(far) / n}};
  }
};

DisplayImage display_of(const Truth& truth) {
  StoredImage stored;
  stored.image.width_px = truth.width_px, stored.image.height_px = truth.height_px;
  const char* names[] = {"R", "G", "B"};
  for (int i = 0; i < 3; ++i) stored.image.add(names[i], truth.rgb[i]);
  return to_display(stored);
}

/// A grey picture of shares of light.
Image8 grey(const std::vector<float>& lit, int width_px, int height_px) {
  Image image;
  image.width_px = width_px, image.height_px = height_px;
  for (const char* name : {"R", "G", "B"}) image.add(name, lit);
  return preview(image);
}

Image8 part_of(const Image8& picture, const PixelRect& r) {
  Image8 part{r.width, r.height, picture.components, {}};
  const size_t row = size_t(r.width) * size_t(picture.components);
  for (int y = r.y; y < r.y + r.height; ++y) {
    const auto from = picture.pixels.begin() + (long(y) * picture.width_px + r.x) * picture.components;
    part.pixels.insert(part.pixels.end(), from, from + long(row));
  }
  return part;
}

/// Where `values` sum to the most, on a raster of half the window.
PixelRect richest(const std::vector<float>& values, int width_px, int height_px) {
  PixelRect best{0, 0, std::min(width_px, std::max(32, width_px / 6)),
                 std::min(height_px, std::max(20, height_px / 6))};
  double most = -1.0;
  PixelRect r = best;
  for (r.y = 0; r.y + r.height <= height_px; r.y += std::max(1, r.height / 2))
    for (r.x = 0; r.x + r.width <= width_px; r.x += std::max(1, r.width / 2)) {
      double sum = 0.0;
      for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x) sum += values[size_t(y) * size_t(width_px) + size_t(x)];
      if (sum > most) most = sum, best = r;
    }
  return best;
}

struct Judged {
  Subject* subject = nullptr;
  std::vector<float> lit, error;  ///< error: how much more light than in truth
  double mean = 0.0;              ///< of |error| over inner pixels
};

Judged judge(Subject& s, const Truth& truth, const DisplayImage& truth_display, json& its) {
  Judged judged{&s, lit_share(*s.renderer), {}, 0.0};
  judged.error.resize(judged.lit.size());
  const std::vector<uint8_t> is_flat = flat_pixels(*s.renderer);
  Errors all, inner, flat;
  for (size_t i = 0; i < judged.lit.size(); ++i) {
    judged.error[i] = judged.lit[i] - truth.lit[i];
    if (truth.surface[i] > 0.0f) all.add(judged.error[i]);
    if (is_inner(truth, i)) inner.add(judged.error[i]);
    if (is_inner(truth, i) && is_flat[i]) flat.add(judged.error[i]);
  }
  judged.mean = inner.pixels ? inner.sum / double(inner.pixels) : 0.0;
  its["error"] = {{"all", all.to_json()}, {"inner", inner.to_json()}, {"flat", flat.to_json()}};
  StoredImage stored;
  stored.image.width_px = truth.width_px, stored.image.height_px = truth.height_px;
  std::vector<glm::vec4> picture(truth.lit.size());
  s.renderer->picture().read_bytes(GL_RGBA, GL_FLOAT, picture.size() * sizeof(glm::vec4), picture.data());
  picture = flip_rows(std::move(picture), truth.width_px, truth.height_px);
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    std::vector<float> plane(picture.size());
    for (size_t i = 0; i < plane.size(); ++i) plane[i] = picture[i][c];
    stored.image.add(names[c], std::move(plane));
  }
  its["flip_mean"] = pool(flip(truth_display, to_display(stored))).mean;
  return judged;
}

bool same_points(const Subject& a, const Subject& b) {
  const SamplePattern its = a.technique->samples(), theirs = b.technique->samples();
  return its.offsets_px == theirs.offsets_px && its.lifted == theirs.lifted;
}

/// Bits that two masks of 32 samples at the same places do not share.
json mask_difference(Subject& reference, Subject& test) {
  const std::vector<uint8_t> counted = receivers_of(*reference.renderer);
  const MaskDifference d = compare_masks(reference.renderer->read_mask(), test.renderer->read_mask(), 32, counted);
  return {{"differing_percent", d.bits ? 100.0 * double(d.differing()) / double(d.bits) : 0.0},
          {"leaks", d.leaks},
          {"false_shadow", d.false_shadow},
          {"bits", d.bits}};
}

/// The shadows of all where the worst of them is worst, and where izb is the farthest from the truth.
std::vector<json> insets(const Job& job, const Truth& truth, const std::vector<Judged>& all,
                         const std::filesystem::path& folder) {
  std::vector<json> groups;
  const auto add = [&](const std::string& id, const std::string& title, const std::string& caption,
                       const std::vector<float>& where) {
    const PixelRect r = richest(where, truth.width_px, truth.height_px);
    std::vector<json> files;
    const auto add_file = [&](const std::vector<float>& lit, const std::string& label) {
      const std::string name = fmt::format("images/peers-{}-{}-{}.png", file_word(job.scene.name), id, files.size());
      write_png(folder / name, part_of(grey(lit, truth.width_px, truth.height_px), r));
      files.push_back({{"file", name}, {"label", label}});
    };
    add_file(truth.lit, fmt::format("truth, {} rays", truth.rays));
    for (const Judged& j : all) add_file(j.lit, j.subject->configuration.name);
    groups.push_back({{"title", title}, {"caption", caption}, {"files", files}, {"pixelated", true}});
  };
  const Judged *ours = nullptr, *best_map = nullptr;
  for (const Judged& j : all) {
    if (j.subject->configuration.notes.value("role", "") == "ours") ours = &j;
    if (j.subject->configuration.technique == "shadow_map" && (!best_map || j.mean < best_map->mean)) best_map = &j;
  }
  if (!ours || !best_map) return groups;
  std::vector<float> gain(truth.lit.size()), loss(truth.lit.size());
  for (size_t i = 0; i < gain.size(); ++i) {
    const float difference = std::abs(best_map->error[i]) - std::abs(ours->error[i]);
    gain[i] = std::max(difference, 0.0f), loss[i] = std::max(-difference, 0.0f);
  }
  add("gain", job.scene.name + ": where izb gains the most on the best map",
      fmt::format("Shares of light; the best map on the mean is \"{}\".", best_map->subject->configuration.name), gain);
  add("loss", job.scene.name + ": where izb loses the most to it",
      "Samples stand on the tangent plane at the pixel's centre; the truth sees every surface in the pixel.", loss);
  std::vector<json> maps;
  for (const Judged* j : {ours, best_map}) {
    std::vector<float> error(j->error.size());
    std::transform(j->error.begin(), j->error.end(), error.begin(), [](float e) { return std::abs(e); });
    const std::string name = fmt::format("images/peers-{}-error-{}.png", file_word(job.scene.name), maps.size());
    write_png(folder / name, heat_map(error, truth.width_px, truth.height_px, 1.0f));
    maps.push_back({{"file", name}, {"label", j->subject->configuration.name}});
  }
  groups.push_back({{"title", job.scene.name + ": error of the share of light"},
                    {"caption", "From 0 (dark) to 1 (bright)."},
                    {"files", maps},
                    {"pixelated", true}});
  return groups;
}

}  // namespace

void measure_quality(const Job& job, Subjects& subjects, const std::filesystem::path& folder, json& result) {
  const Truth truth = read_truth(job, folder);
  const DisplayImage truth_display = display_of(truth);
  measure_times(job, subjects, folder, result);
  std::vector<Judged> all;
  Subject* rays = nullptr;
  for (Subject& s : subjects.all())
    if (s.works() && s.configuration.notes.value("role", "") == "rays") rays = &s;
  size_t i = 0;
  for (Subject& s : subjects.all()) {
    json& its = result["configurations"][i++];
    if (!s.works()) continue;
    all.push_back(judge(s, truth, truth_display, its));
    if (rays && same_points(*rays, s)) its["against_rays"] = mask_difference(*rays, s);
  }
  result["truth"] = {{"rays", truth.rays}};
  result["pictures"] = insets(job, truth, all, folder);
}

}  // namespace izb::bench

// SPDX-License-Identifier: MIT
#include "app/compare_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "image/display.h"
#include "image/heat_map.h"
#include "image/metrics.h"
#include "scene/find.h"

namespace izb {
namespace {

using Names = std::set<std::string>;

struct Side {
  std::string path;
  StoredImage stored;

  const Image& image() const { return stored.image; }
  const char* format() const { return stored.linear ? "OpenEXR" : "PNG"; }
};

const Names color_names{"R", "G", "B"};

bool is_mask(const Channel& channel) {
  return std::holds_alternative<std::vector<uint32_t>>(channel.data) &&
         (channel.name == "mask" || channel.name.starts_with("mask."));
}

Names all_names(const Image& image) {
  Names names;
  for (const Channel& channel : image.channels) names.insert(channel.name);
  return names;
}

Names mask_names(const Image& image) {
  Names names;
  for (const Channel& channel : image.channels)
    if (is_mask(channel)) names.insert(channel.name);
  return names;
}

/// The channels of one file that the text chooses.
Names chosen_names(const Side& side, const std::string& text) {
  const Names all = all_names(side.image()), masks = mask_names(side.image());
  if (text == "all") return all;
  if (text == "masks") {
    if (masks.empty())
      fail("'{}' has no channel of unsigned integers named mask or mask.NAME, but {}", side.path, fmt::join(all, ", "));
    return masks;
  }
  if (text == "auto") {
    // What a technique says about itself, such as the lengths of its lists, is no part of the frame.
    Names names = masks;
    for (const char* name : {"R", "G", "B", "A"})
      if (all.contains(name)) names.insert(name);
    return names.empty() ? all : names;
  }
  Names names = color_names;
  if (text != "color") {
    const std::vector<std::string> parts = list_of(text);
    if (parts.empty()) throw UsageError("--channels names no channel");
    names = {parts.begin(), parts.end()};
  }
  for (const std::string& name : names)
    if (!all.contains(name)) fail("'{}' has no channel '{}', but {}", side.path, name, fmt::join(all, ", "));
  return names;
}

/// "only 'a.exr' has depth, mask", or nothing.
std::string surplus(const Side& side, const Names& its, const Names& others) {
  std::vector<std::string> more;
  std::set_difference(its.begin(), its.end(), others.begin(), others.end(), std::back_inserter(more));
  return more.empty() ? "" : fmt::format(", only '{}' has {}", side.path, fmt::join(more, ", "));
}

/// The same channels of both files, of the same type.
Names common_names(const Side& a, const Side& b, const std::string& text) {
  const Names of_a = chosen_names(a, text), of_b = chosen_names(b, text);
  if (of_a != of_b)
    fail("the files have different channels{}{}; --channels chooses which to compare", surplus(a, of_a, of_b),
         surplus(b, of_b, of_a));
  if (of_a.empty()) fail("'{}' and '{}' have no channels", a.path, b.path);
  for (const std::string& name : of_a) {
    const bool uints_a = a.image().find(name)->data.index() == 1, uints_b = b.image().find(name)->data.index() == 1;
    if (uints_a != uints_b)
      fail("channel '{}' holds unsigned integers in '{}', but not in '{}'", name, uints_a ? a.path : b.path,
           uints_a ? b.path : a.path);
  }
  return of_a;
}

/// Differences with what is not finite are no numbers, and neither are means over them.
void check_finite(const Side& side, const std::string& name) {
  const auto* values = std::get_if<std::vector<float>>(&side.image().find(name)->data);
  if (!values) return;
  const auto bad = std::find_if(values->begin(), values->end(), [](float v) { return !std::isfinite(v); });
  if (bad == values->end()) return;
  const auto at = int(bad - values->begin());
  fail("'{}' has {} in channel '{}' at pixel ({}, {}), counted from the top left", side.path,
       std::isnan(*bad) ? "a NaN" : "an infinite value", name, at % side.image().width_px, at / side.image().width_px);
}

std::vector<float> as_floats(const Channel& channel) {
  return std::visit([](const auto& values) { return std::vector<float>(values.begin(), values.end()); }, channel.data);
}

/// JSON has no infinity.
nlohmann::json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

void compare_color(const Side& a, const Side& b, const CompareFilesOptions& o, Comparison& result) {
  const DisplayImage reference = to_display(a.stored, o.exposure_stops), test = to_display(b.stored, o.exposure_stops);
  const double error = rmse(reference, test);
  const std::optional<double> similarity = ssim(reference, test);
  std::vector<float> errors = flip(reference, test, o.pixels_per_degree);
  const Pooled pooled = pool(errors);
  result.json["color"] = {{{"name", "R G B"},
                           {"rmse", error},
                           {"psnr_db", finite_or_null(psnr_db(error))},
                           {"ssim", similarity ? nlohmann::json(*similarity) : nlohmann::json()},
                           {"flip_mean", pooled.mean},
                           {"flip_weighted_median", pooled.weighted_median},
                           {"flip_max", pooled.max}}};
  result.pictures.push_back(heat_map(errors, result.width_px(), result.height_px(), 1.0f));
  result.errors.add("flip", std::move(errors));
}

/// Where the reference sees a surface; empty: it does not say.
std::vector<uint8_t> receivers_of(const Image& reference) {
  const Channel* const depth = reference.find("depth");
  const auto* distances = depth ? std::get_if<std::vector<float>>(&depth->data) : nullptr;
  if (!distances) return {};
  std::vector<uint8_t> receivers(distances->size());
  std::transform(distances->begin(), distances->end(), receivers.begin(), [](float d) { return d > 0.0f; });
  return receivers;
}

void compare_all_masks(const Side& a, const Side& b, const Names& names, Comparison& result) {
  const std::vector<uint8_t> receivers = receivers_of(a.image());
  int spp = 1;
  for (const std::string& name : names)
    spp = std::max({spp, samples_of(a.image().uints(name)), samples_of(b.image().uints(name))});
  for (const std::string& name : names) {
    const std::vector<uint32_t>&reference = a.image().uints(name), &test = b.image().uints(name);
    result.json["masks"].push_back(mask_json(name, compare_masks(reference, test, spp, receivers)));
    result.pictures.push_back(
        mask_difference_picture(reference, test, spp, receivers, result.width_px(), result.height_px()));
    add_coverage_errors(result.errors, name, reference, test, spp, receivers);
  }
}

void compare_channel_values(const Side& a, const Side& b, const std::string& name, Comparison& result) {
  const std::vector<float> reference = as_floats(*a.image().find(name)), test = as_floats(*b.image().find(name));
  const ValueDifference difference = compare_values(reference, test);
  const int at = int(difference.largest_at), width = result.width_px();
  result.json["values"].push_back({{"name", name},
                                   {"rmse", difference.rmse},
                                   {"mean_difference", difference.mean_abs},
                                   {"largest_difference", difference.largest},
                                   {"largest_at", {at % width, at / width}}});
  std::vector<float> errors(reference.size()), sizes(reference.size());
  for (size_t i = 0; i < errors.size(); ++i) errors[i] = test[i] - reference[i], sizes[i] = std::abs(errors[i]);
  const float brightest = difference.largest > 0.0 ? float(difference.largest) : 1.0f;
  result.pictures.push_back(heat_map(sizes, width, result.height_px(), brightest));
  result.errors.add("difference." + name, std::move(errors));
}

}  // namespace

Comparison compare_files(const std::string& reference, const std::string& test, const CompareFilesOptions& o) {
  const Side a{reference, read_image(reference)}, b{test, read_image(test)};
  const Image &of_a = a.image(), &of_b = b.image();
  if (of_a.width_px != of_b.width_px || of_a.height_px != of_b.height_px)
    fail("the images differ in size: '{}' has {} x {} pixels, '{}' {} x {}", a.path, of_a.width_px, of_a.height_px,
         b.path, of_b.width_px, of_b.height_px);
  Names names = common_names(a, b, o.channels);
  for (const std::string& name : names)
    for (const Side* side : {&a, &b}) check_finite(*side, name);

  Comparison result;
  result.errors.width_px = of_a.width_px, result.errors.height_px = of_a.height_px;
  result.json = {{"reference", {{"file", a.path}, {"format", a.format()}}},
                 {"test", {{"file", b.path}, {"format", b.format()}}},
                 {"width_px", of_a.width_px},
                 {"height_px", of_a.height_px},
                 {"channels", names}};
  const bool color = std::all_of(color_names.begin(), color_names.end(), [&](const std::string& name) {
    return names.contains(name) && of_a.find(name)->data.index() == 0;
  });
  if (o.exposure_stops != 0.0 && !(color && a.stored.linear && b.stored.linear))
    throw UsageError("--exposure is for linear colour in OpenEXR: a PNG holds what a display shows");
  if (color) {
    compare_color(a, b, o, result);
    for (const std::string& name : color_names) names.erase(name);
  }
  Names masks;
  for (const std::string& name : mask_names(of_a))
    if (names.erase(name) > 0) masks.insert(name);
  if (!masks.empty()) compare_all_masks(a, b, masks, result);
  for (const std::string& name : names) compare_channel_values(a, b, name, result);
  return result;
}

}  // namespace izb

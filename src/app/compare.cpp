// SPDX-License-Identifier: MIT
// izb compare: how far an image, or the masks of a frame, are from a reference or from the ray-traced truth.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>

#include "app/commands.h"
#include "app/compare_files.h"
#include "app/compare_truth.h"
#include "app/outputs.h"
#include "app/results.h"
#include "base/error.h"
#include "base/json_text.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb {
namespace {

/// Values of the limits that limit nothing: the worst that there is, and where there is no worst, -1.
constexpr double worst_error = 1.0, worst_percent = 100.0, worst_ssim = -1.0, worst_psnr_db = 0.0, no_worst = -1.0;

struct Limits {
  double flip = worst_error, rmse = worst_error, psnr_db = worst_psnr_db, ssim = worst_ssim;
  double differing = worst_percent, leaks = worst_percent, false_shadow = worst_percent, unexplained = worst_percent;
  double coverage = worst_error, difference = no_worst;

  OptionSet options() {
    OptionSet set;
    set.number("max-flip", flip, 0.0, worst_error, "", "colour: the largest mean FLIP");
    set.number("max-rmse", rmse, 0.0, worst_error, "", "colour: the largest RMSE");
    set.number("min-psnr", psnr_db, worst_psnr_db, std::numeric_limits<double>::infinity(), "dB",
               "colour: the smallest PSNR");
    set.number("min-ssim", ssim, worst_ssim, 1.0, "", "colour: the smallest SSIM");
    set.number("max-differing-bits", differing, 0.0, worst_percent, "percent",
               "masks: the largest share of the compared bits that differ");
    set.number("max-leaks", leaks, 0.0, worst_percent, "percent",
               "masks: the largest share of the reference's shadowed bits that are lit");
    set.number("max-false-shadow", false_shadow, 0.0, worst_percent, "percent",
               "masks: the largest share of the reference's lit bits that are shadowed");
    set.number("max-coverage-error", coverage, 0.0, worst_error, "",
               "masks: the largest mean error of a pixel's shadowed share");
    set.number(
        "max-unexplained", unexplained, 0.0, worst_percent, "percent",
        "with --truth: the largest share of the compared bits that are wrong and not within 1/64 pixel of right");
    set.number("max-difference", difference, no_worst, std::numeric_limits<double>::infinity(), "the channel's unit",
               "other channels: the largest absolute difference; -1: no limit");
    return set;
  }

  std::vector<Limit> list() const {
    return {{"max-flip", "color", "flip_mean", flip, worst_error},
            {"max-rmse", "color", "rmse", rmse, worst_error},
            {"min-psnr", "color", "psnr_db", psnr_db, worst_psnr_db, true},
            {"min-ssim", "color", "ssim", ssim, worst_ssim, true},
            {"max-differing-bits", "masks", "differing_percent", differing, worst_percent},
            {"max-leaks", "masks", "leak_percent", leaks, worst_percent},
            {"max-false-shadow", "masks", "false_shadow_percent", false_shadow, worst_percent},
            {"max-coverage-error", "masks", "mean_coverage_error", coverage, worst_error},
            {"max-unexplained", "masks", "unexplained_percent", unexplained, worst_percent},
            {"max-difference", "values", "largest_difference", difference, no_worst}};
  }
};

struct CompareOptions {
  std::vector<std::string> files;
  CompareFilesOptions images;
  std::string truth, json, error_map;
  Limits limits;
  FrameOptions frame;
  std::unique_ptr<Technique> ray_traced = make_technique("ray_traced");
  Arguments arguments;

  OptionSet output_options() {
    OptionSet set;
    set.text("json", json, "FILE", "write the tables' numbers as JSON");
    set.text("error-map", error_map, "FILE",
             "write the error of each pixel: .exr for its numbers (flip; coverage_error, above 0 in false shadow; "
             "difference.NAME), .png for a picture, of several errors side by side: FLIP and differences from black to "
             "pale yellow, masks red where they leak and blue in false shadow, with --truth the colours of izb "
             "validate --heatmap");
    return set;
  }

  OptionSet image_options() {
    OptionSet set;
    set.text("channels", images.channels, "auto|color|masks|all|NAMES",
             "what to compare: R, G and B; channels mask and mask.NAME of unsigned integers; all; or names with "
             "semicolons between them; auto: R, G, B, A and the masks, or all where a file has none of these");
    set.number("exposure", images.exposure_stops, -100.0, 100.0, "stops",
               "colour of OpenEXR files is multiplied by 2 to that before it is clamped to [0, 1] and encoded as sRGB");
    set.number("ppd", images.pixels_per_degree, 1.0, 1000.0, "pixels per degree",
               "how the picture is seen, for FLIP; the default is a 0.7 m wide display of 3840 pixels from 0.7 m");
    return set;
  }

  /// The truth has one technique, and by default the mask's size.
  OptionSet truth_options() {
    frame.size.clear();
    return frame.options(false);
  }
};

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

void check_usage(const CompareOptions& o) {
  if (o.truth.empty() && o.files.size() != 2)
    throw UsageError("compare takes two files, the reference and the one to judge, or --truth SCENE and one");
  if (!o.truth.empty() && o.files.size() != 1)
    throw UsageError("with --truth compare takes one file, that of the masks to judge");
  const std::string extension = extension_of(o.error_map);
  if (!o.error_map.empty() && extension != ".png" && extension != ".exr")
    throw UsageError(fmt::format("--error-map must end in .png or .exr, not '{}'", o.error_map));
}

int compare(CompareOptions& o) {
  check_usage(o);
  Outputs outputs;
  AtomicFile* const text = outputs.open("--json", o.json);
  AtomicFile* const map = outputs.open("--error-map", o.error_map);
  Comparison result = o.truth.empty() ? compare_files(o.files[0], o.files[1], o.images)
                                      : compare_with_truth(o.truth, o.files[0], o.frame, std::move(o.ray_traced));
  result.json.update(origin_json(o.arguments));
  if (o.truth.empty()) result.json["options"] = o.image_options().to_json();
  result.json["limits"] = o.limits.options().to_json();
  const std::vector<std::string> broken = broken_limits(result, o.limits.list());
  result.json["broken_limits"] = broken;

  print_tables(result);
  const std::string json_file = json_text(result.json, 1) + "\n";
  if (text) text->write(std::as_bytes(std::span(json_file)));
  if (map && extension_of(o.error_map) == ".png") write_png(*map, side_by_side(result.pictures, 4, {0, 0, 0}));
  if (map && extension_of(o.error_map) == ".exr") write_exr(*map, result.errors);
  outputs.commit();
  return broken.empty() ? 0 : 1;
}

/// Options that mean nothing without --truth, or with it, are refused rather than ignored.
void tie_to_truth(CLI::App& sub, const OptionSet& set, bool with) {
  CLI::Option* const truth = sub.get_option("--truth");
  for (const Option& option : set.options()) {
    CLI::Option* const its = sub.get_option("--" + option.name);
    if (with)
      its->needs(truth);
    else
      its->excludes(truth);
  }
}

}  // namespace

Command add_compare(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<CompareOptions>();
  o->arguments = arguments;
  CLI::App* sub = app.add_subcommand("compare", "Compare an image or a shadow mask with a reference or with rays");
  sub->add_option("FILE", o->files,
                  "OpenEXR or PNG, of whatever program: the reference and the one to judge, of the same size; with "
                  "--truth the one to judge alone")
      ->required();
  OptionSet truth;
  truth.text("truth", o->truth, "SCENE",
             "judge the masks of an OpenEXR file against the ray-traced truth of this .gltf or .glb file, as izb "
             "validate does; the options of the frame say which frame the masks are of");
  truth.add_to(*sub, "Truth");
  o->output_options().add_to(*sub, "Output");
  const OptionSet images = o->image_options(), frame = o->truth_options(), samples = o->ray_traced->options();
  images.add_to(*sub, "Two files");
  o->limits.options().add_to(*sub, "Limits: exit code 1 beyond them");
  frame.add_to(*sub, "Frame of --truth (the size: by default the mask's)");
  samples.add_to(*sub, "Samples of --truth");
  tie_to_truth(*sub, images, false);
  tie_to_truth(*sub, frame, true);
  tie_to_truth(*sub, samples, true);
  sub->get_option("--fov")->needs(sub->get_option("--eye"));
  sub->footer(
      "RMSE, PSNR, SSIM (luma, 11 x 11 Gaussian window, sigma 1.5) and FLIP (Andersson et al. 2020) are of what a "
      "display\n"
      "shows: sRGB code values in [0, 1]. A mask has a bit for each sample, set in shadow; it is compared where the\n"
      "reference's channel depth, if there is one, is above 0. docs/COMPARE.md defines each number.\n"
      "Exit code 1 if a limit is broken.");
  return [o] { return compare(*o); };
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "app/compare_truth.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "app/results.h"
#include "app/session.h"
#include "app/validate_report.h"
#include "app/verdict_picture.h"
#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "image/display.h"
#include "reference/settle.h"
#include "shadow/ray_traced/receivers.h"

namespace izb {
namespace {

using reference::Receivers;
using reference::Settled;

Image read_masks(const std::string& path) {
  StoredImage stored = read_image(path);
  if (!stored.linear) fail("'{}' is a PNG: a mask is a channel of unsigned integers in an OpenEXR file", path);
  return std::move(stored.image);
}

std::string channel_names(const Image& image) {
  std::vector<std::string> names;
  for (const Channel& channel : image.channels) names.push_back(channel.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const std::vector<uint32_t>& mask_of(const Image& image, const std::string& path, const std::string& name) {
  const Channel* const channel = image.find(name);
  const auto* words = channel ? std::get_if<std::vector<uint32_t>>(&channel->data) : nullptr;
  if (!channel) fail("'{}' has no channel '{}', but {}", path, name, channel_names(image));
  if (!words) fail("channel '{}' of '{}' holds floats, but a mask is of unsigned integers, a bit a sample", name, path);
  return *words;
}

/// A mask whose samples are not those of the truth is not wrong but misread.
void check_samples(const std::vector<uint32_t>& mask, int spp, const std::string& path, const std::string& name) {
  const int its = samples_of(mask);
  if (its > spp)
    fail("the mask '{}' in '{}' has words other than 0 and 0xFFFFFFFF, but --spp 1 is asked for", name, path);
  if (its < spp)
    warn("every word of the mask '{}' in '{}' is 0 or 0xFFFFFFFF: with one sample a pixel --spp must be 1", name, path);
}

/// The mask with its wrong bits turned: settling recorded all of them.
std::vector<uint32_t> true_mask(const Receivers& receivers, const Settled& settled, std::vector<uint32_t> mask) {
  if (receivers.sample_count() == 1)
    for (uint32_t& word : mask) word = word == 0 ? 0 : ~0u;
  for (const reference::DisputedBit& bit : settled.records) mask[bit.receiver] ^= receivers.word_of(bit.sample);
  return mask;
}

void compare_light(Session& s, const GBufferImage& gbuffer, const reference::Triangles& triangles, size_t light,
                   const std::vector<uint32_t>& mask, const std::string& name, Comparison& result) {
  const FrameInputs& in = s.renderer.inputs(light);
  const Receivers receivers = make_receivers(gbuffer, in);
  const Settled settled = reference::settle(triangles, make_light_point(in.light), receivers, mask,
                                            s.renderer.read_mask(light), std::numeric_limits<size_t>::max());
  const std::vector<uint32_t> truth = true_mask(receivers, settled, mask);
  std::vector<uint8_t> counted(mask.size());
  std::transform(receivers.classes.begin(), receivers.classes.end(), counted.begin(),
                 [](reference::PixelClass c) { return c == reference::PixelClass::receiver; });

  const int spp = receivers.sample_count();
  nlohmann::json json = mask_json(name, compare_masks(truth, mask, spp, counted));
  const nlohmann::json verdicts = settled_json(settled);
  for (const char* key : {"disputed", "settled_ours", "explained", "explained_by_alpha", "unexplained", "left_out"})
    json[key] = verdicts[key];
  json["unexplained_percent"] = settled.compared ? 100.0 * double(settled.unexplained) / double(settled.compared) : 0.0;
  if (settled.unexplained > 0) json["records"] = records_json(settled, in.width_px);
  result.json["masks"].push_back(std::move(json));
  result.pictures.push_back(verdict_picture(receivers, settled, mask, nullptr, s.frame.size));
  add_coverage_errors(result.errors, name, truth, mask, spp, counted);
}

}  // namespace

Comparison compare_with_truth(const std::string& scene, const std::string& path, FrameOptions frame,
                              std::unique_ptr<Technique> ray_traced) {
  const Image image = read_masks(path);
  if (frame.size.empty()) frame.size = fmt::format("{}x{}", image.width_px, image.height_px);
  const Size size = parse_size(frame.size);
  if (size.width_px != image.width_px || size.height_px != image.height_px)
    fail("'{}' has {} x {} pixels, but --size is {}", path, image.width_px, image.height_px, frame.size);

  Session s(frame, std::move(ray_traced), scene);
  std::vector<std::string> names;
  for (size_t i = 0; i < s.frame.lights.size(); ++i) {
    names.push_back("mask" + channel_suffix(s.frame.lights, i));
    check_samples(mask_of(image, path, names[i]), s.technique->samples().count(), path, names[i]);
  }
  Progress progress("tracing " + scene, 1 + names.size());
  s.renderer.render(s.frame.camera, s.frame.lights, s.timers);
  s.timers.collect();
  const GBufferImage gbuffer = read_gbuffer(*s.renderer.inputs().gbuffer);
  const reference::Triangles triangles = make_triangles(s.renderer.inputs());
  progress.advance();

  Comparison result;
  result.errors.width_px = size.width_px, result.errors.height_px = size.height_px;
  result.json = {{"truth", {{"scene", scene}, {"options", frame.options(false).to_json()}}},
                 {"test", {{"file", path}, {"format", "OpenEXR"}}},
                 {"width_px", size.width_px},
                 {"height_px", size.height_px},
                 {"channels", names}};
  result.json["truth"]["options"].update(s.technique->options().to_json());
  for (size_t i = 0; i < names.size(); ++i) {
    progress.relabel("settling disputed bits of " + names[i]);
    compare_light(s, gbuffer, triangles, i, mask_of(image, path, names[i]), names[i], result);
    progress.advance();
  }
  return result;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "app/statistics.h"

#include "app/results.h"
#include "frame/read_back.h"

namespace izb {
namespace {

/// Receivers, and those of them that no sample sees the light from.
Counts receiver_counts(const Renderer& renderer, size_t light) {
  const FrameInputs& in = renderer.inputs(light);
  const GBufferImage gbuffer = read_gbuffer(*in.gbuffer);
  const std::vector<uint32_t> mask = renderer.read_mask(light);
  uint64_t receivers = 0, fully_shadowed = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (pixel_class(gbuffer, in.camera, in.light, i) != shared::class_receiver) continue;
    ++receivers;
    fully_shadowed += mask[i] == ~0u;
  }
  return {{"receivers", receivers}, {"fully_shadowed", fully_shadowed}};
}

/// Of what the technique counts at all; nothing is divided by 0.
nlohmann::json averages_json(const nlohmann::json& counts) {
  struct Average {
    const char *name, *sum, *number;
  };
  nlohmann::json averages = nlohmann::json::object();
  for (const Average& a : {Average{"nodes_a_receiver", "nodes", "receivers"},
                           {"nodes_a_list", "nodes", "lists"},
                           {"tests_a_fragment", "visibility_tests", "fragments_after_zcull"},
                           {"tests_a_receiver", "visibility_tests", "receivers"}}) {
    if (!counts.contains(a.sum) || counts.value(a.number, uint64_t{0}) == 0) continue;
    averages[a.name] = counts[a.sum].get<double>() / counts[a.number].get<double>();
  }
  return averages;
}

}  // namespace

void add_statistics(nlohmann::json& json, const RenderedFrame& rendered, bool unculled) {
  nlohmann::json all = nlohmann::json::object();
  std::vector<uint64_t> histogram;
  for (size_t light = 0; light < rendered.renderer.light_count(); ++light) {
    nlohmann::json counts = counts_json(rendered.renderer.count(light, unculled));
    counts.update(counts_json(receiver_counts(rendered.renderer, light)));
    for (const auto& [name, value] : counts.items()) {
      const uint64_t before = all.value(name, uint64_t{0}), its = value.get<uint64_t>();
      all[name] = name == "longest_list" ? std::max(before, its) : before + its;
    }
    const std::vector<uint64_t> its = rendered.renderer.list_histogram(light);
    if (histogram.size() < its.size()) histogram.resize(its.size());
    for (size_t n = 0; n < its.size(); ++n) histogram[n] += its[n];
    if (rendered.renderer.light_count() > 1)
      json["lights"][light].update({{"counts", counts}, {"averages", averages_json(counts)}});
  }
  json["counts"] = all;
  json["averages"] = averages_json(all);
  if (!histogram.empty()) json["list_histogram"] = std::move(histogram);
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "app/statistics.h"

#include "app/results.h"
#include "frame/read_back.h"

namespace izb {
namespace {

/// Receivers, and those of them that no sample sees the light from.
Counts receiver_counts(const Renderer& renderer) {
  const FrameInputs& in = renderer.inputs();
  const GBufferImage gbuffer = read_gbuffer(*in.gbuffer);
  const std::vector<uint32_t> mask = renderer.read_mask();
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

nlohmann::json statistics_json(Session& session) {
  nlohmann::json json;
  json["counts"] = counts_json(session.renderer.count());
  json["counts"].update(counts_json(receiver_counts(session.renderer)));
  json["averages"] = averages_json(json["counts"]);
  if (std::vector<uint64_t> histogram = session.technique->list_histogram(session.renderer.inputs());
      !histogram.empty())
    json["list_histogram"] = std::move(histogram);
  return json;
}

}  // namespace izb

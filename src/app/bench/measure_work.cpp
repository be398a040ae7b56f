// SPDX-License-Identifier: MIT
// Table 2 and figure 10: what the tests alone would take, and how many a ray tracer needs.
#include "app/bench/measure_parts.h"
#include "app/results.h"
#include "base/error.h"
#include "base/progress.h"
#include "reference/beam.h"
#include "shadow/ray_traced/receivers.h"

namespace izb::bench {

void measure_speed_of_light(const Job& job, Subjects& subjects, const std::filesystem::path& folder,
                            nlohmann::json& result) {
  measure_times(job, subjects, folder, result);
  size_t i = 0;
  for (Subject& s : subjects.all()) {
    nlohmann::json& its = result["configurations"][i++];
    if (!s.works()) continue;
    try {
      const std::optional<SpeedOfLight> light = s.renderer->speed_of_light(0, job.frames);
      if (!light) fail("this technique makes no such tests");
      its["speed_of_light"] = {{"tests", light->tests},
                               {"ms", median(light->ms)},
                               {"samples_ms", light->ms},
                               {"same_mask", light->same_mask}};
      if (!light->same_mask) fail("the stored tests alone gave another mask");
    } catch (const Error& e) {
      its["speed_of_light_failed"] = e.what();
    }
  }
}

void measure_beams(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result) {
  measure_times(job, subjects, folder, result);
  size_t i = 0;
  for (Subject& s : subjects.all()) {
    nlohmann::json& its = result["configurations"][i++];
    if (!s.works()) continue;
    const FrameInputs& in = s.renderer->inputs();
    const reference::BeamTracer tracer(make_triangles(in));
    const reference::BeamCount count =
        tracer.trace(make_light_point(in.light), make_receivers(read_gbuffer(*in.gbuffer), in));
    its["beams"] = {{"pixels", count.pixels},
                    {"tests", count.tests},
                    {"node_tests", count.node_tests},
                    {"tests_a_receiver", count.pixels ? double(count.tests) / double(count.pixels) : 0.0},
                    {"node_tests_a_receiver", count.pixels ? double(count.node_tests) / double(count.pixels) : 0.0},
                    {"build_ms", count.build_ms},
                    {"trace_ms", count.trace_ms}};
  }
}

}  // namespace izb::bench

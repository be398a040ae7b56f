// SPDX-License-Identifier: MIT
#include "app/bench/machine.h"
#include "app/bench/measure_parts.h"
#include "app/bench/measures.h"
#include "base/error.h"

namespace izb::bench {
namespace {

using Measure = void (*)(const Job&, Subjects&, const std::filesystem::path& folder, nlohmann::json& result);

struct Named {
  const char* name;
  Measure measure;
};

constexpr Named measures[] = {
    {"times", measure_times}, {"animation", measure_animation}, {"speed_of_light", measure_speed_of_light},
    {"beams", measure_beams}, {"temporal", measure_temporal},   {"quality", measure_quality}};

}  // namespace

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const Named& m : measures) names.push_back(m.name);
  return names;
}

nlohmann::json run_job(const Job& job, const std::filesystem::path& folder) {
  const auto it =
      std::find_if(std::begin(measures), std::end(measures), [&](const Named& m) { return job.measure == m.name; });
  if (it == std::end(measures)) fail("the sweep asks for a measure '{}', which there is not", job.measure);
  Subjects subjects(job);
  const Scene& scene = subjects.session().scene;
  nlohmann::json result{{"job", to_json(job)},
                        {"made", made_json(subjects.session().gl)},
                        {"scene", {{"triangles", scene.triangle_count()}, {"geometry_bytes", scene.geometry_bytes()}}}};
  it->measure(job, subjects, folder, result);
  return result;
}

}  // namespace izb::bench

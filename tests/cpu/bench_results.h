// SPDX-License-Identifier: MIT
// Results of jobs as `izb bench-job` writes them, with made-up numbers: for tests of what is made of them.
#pragma once
#include <nlohmann/json.hpp>

#include "app/bench/runner.h"
#include "base/file.h"

namespace izb::test {

using bench::Configuration;
using bench::Job;
using bench::Measured;
using nlohmann::json;

inline json bench_data(const std::string& name) {
  return json::parse(read_text_file(std::string(IZB_SOURCE_DIR) + "/bench/" + name));
}

inline json made_up_conditions() {
  return {{"version", "1.2.3 (abc)"},
          {"date", "2015-02-27T12:00:00Z"},
          {"machine", {{"processor", "P"}, {"cores", 2}, {"memory_bytes", 8e9}, {"system", "S"}}},
          {"gl", {{"context", "egl"}, {"vendor", "V"}, {"renderer", "R"}, {"version", "4.5"}}},
          {"software", true},
          {"timing", "wall"},
          {"embree", "Embree 3"}};
}

/// Of one configuration: the number `n` tells it from others.
inline json made_up_configuration(const Job& job, const Configuration& c, int n) {
  json its{{"name", c.name}, {"technique", c.technique}, {"notes", c.notes}, {"stages", json::array()}};
  const auto error = [&](double mean) {
    return json{{"pixels", 100},
                {"mean", mean},
                {"rmse", 2 * mean},
                {"leaks", 0.25 * mean},
                {"false_shadow", 0.75 * mean},
                {"pixels_above_an_eighth", 0.5 * mean}};
  };
  if (job.measure == "temporal") {
    its["temporal"] = {{"flips", 5 * n},
                       {"flips_a_thousand_pixel_steps", 0.5 * n},
                       {"mean_change", 0.01 * n},
                       {"mean_difference_from_truth", n == 1 ? 0.0 : 0.002 * n}};
    return its;
  }
  std::vector<const char*> stages{"gbuffer", "build", "visibility", "shade"};
  if (c.technique == "izb") stages = {"gbuffer", "bounds", "occluders", "build", "zcull", "visibility", "shade"};
  double sum = 0.0;
  for (size_t i = 0; i < stages.size(); ++i) {
    const double ms = double(n) * double(i + 1);
    its["stages"].push_back({{"name", stages[i]}, {"gpu_ms", ms}, {"samples", std::vector<double>(3, ms)}});
    sum += ms;
  }
  its["frame_ms"] = sum;
  for (int i = 0; i < job.frames; ++i) its["frame_samples"].push_back(sum + i);
  its["memory_bytes"] = {{c.technique, 1000000 * n}, {"gbuffer", 2000000}, {"scene", 3000000}};
  its["memory_peak_bytes"] = 50000000;
  if (c.technique == "izb") {
    its["counts"] = {{"fragments_after_zcull", 1000000 * n}, {"visibility_tests", 3000000 * n}, {"nodes", 2000 * n}};
    its["averages"] = {{"tests_a_fragment", 3.0}, {"tests_a_receiver", 10.0 * n}, {"nodes_a_receiver", 1.5}};
  }
  if (job.measure == "speed_of_light")
    its["speed_of_light"] = {{"tests", 3000000 * n}, {"ms", 0.5 * n}, {"same_mask", true}};
  if (job.measure == "beams") its["beams"] = {{"tests_a_receiver", 4.0}, {"node_tests_a_receiver", 40.0}};
  if (job.measure == "quality") {
    const double mean = c.technique == "shadow_map" ? 0.05 : 0.01;
    its["error"] = {{"all", error(2 * mean)}, {"inner", error(mean)}, {"flat", error(0.5 * mean)}};
    its["flip_mean"] = 0.1;
    if (c.notes.value("role", "") == "ours") its["against_rays"] = {{"differing_percent", 0.125}};
    if (c.notes.value("role", "") == "ours, exact") its["against_rays"] = {{"differing_percent", 0.0}};
    if (c.name == "map 8192, 32 samples") its["against_rays"] = {{"differing_percent", 2.5}};
  }
  return its;
}

/// Of a whole job.
inline json made_up_result(const Job& job) {
  json result{{"job", to_json(job)},
              {"made", made_up_conditions()},
              {"scene", {{"triangles", 1234}, {"geometry_bytes", 5678}}},
              {"configurations", json::array()}};
  int n = 0;
  for (const Configuration& c : job.configurations)
    result["configurations"].push_back(made_up_configuration(job, c, ++n));
  if (job.settings.value("peer", false))
    result["peer"]["low"] = {{"rebuild_ms", 1.0}, {"trace_ms", 3.0}, {"sum_ms", 4.0}};
  return result;
}

}  // namespace izb::test

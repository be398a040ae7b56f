// SPDX-License-Identifier: MIT
// Techniques against the truth: what flickers, and what is wrong, at which cost.
#include <algorithm>

#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "base/error.h"

namespace izb::bench {

using nlohmann::json;

namespace {

void add_pictures(json& section, const Measured& m) {
  if (!m.works() || !m.result.contains("pictures")) return;
  const json& pictures = m.result["pictures"];
  if (!pictures.is_array()) {
    section["images"].push_back(pictures);
    return;
  }
  for (const json& group : pictures) section["images"].push_back(group);
}

std::string percent_text(const json& share) {
  return share.is_number() ? fmt::format("{:.3f}", 100.0 * share.get<double>()) : std::string("-");
}

json role(const Measured& m, const std::string& wanted, const std::string& what, double scale = 1.0) {
  for (const Configuration& c : m.job.configurations)
    if (c.notes.value("role", "") == wanted) return value(m, c.name, what, scale);
  return no_value("not part of this run");
}

/// The best of the shadow maps of a scene, by what is the least for it.
std::string best_map(const Measured& m, const std::string& what = "error/inner/mean") {
  std::string best;
  double least = 0.0;
  for (const Configuration& c : m.job.configurations) {
    if (c.technique != "shadow_map") continue;
    const json error = value(m, c.name, what);
    if (error.is_number() && (best.empty() || error.get<double>() < least)) best = c.name, least = error;
  }
  return best;
}

const std::string unlike_rays = "against_rays/differing_percent";

json bits_unlike_rays(const Measured& m, const std::string& configuration) {
  const json* const c = find_configuration(m, configuration);
  if (c && !c->contains("failed") && !c->contains("against_rays")) return no_value("its samples stand elsewhere");
  return value(m, configuration, unlike_rays);
}

}  // namespace

json temporal_section(const Evidence& e) {
  json section =
      new_section("temporal", "Flicker under motion",
                  {"The camera's grid of pixels moves by a fraction of a pixel a step, or the light turns by a "
                   "fraction of a degree. A flip is a pixel that goes from mostly lit to mostly dark or back. The "
                   "change is that of the share of light a pixel, on the mean over pixels and steps. What moves in "
                   "truth, by rays through many points of each pixel, is the first row: less change than that smears, "
                   "more flickers, and the last column says how far each pixel's change is from the true one."});
  for (const std::string part : {"camera", "light"}) {
    const std::vector<const Measured*> jobs = e.of_part(part);
    if (jobs.empty()) continue;
    ReportTable table("temporal-" + part, "The " + part + " moves",
                      {{.name = "scene", .text = true},
                       {.name = "technique", .text = true},
                       {.name = "flips of a thousand pixels a step", .digits = 2},
                       {.name = "change", .unit = "%", .digits = 3},
                       {.name = "difference from the true change", .unit = "%", .digits = 3}});
    const std::vector<std::string> names = configuration_names(jobs);
    json plot = new_plot("temporal-" + part + "-plot", "bars",
                         "The " + part + " moves: how far a pixel's change is from the true one",
                         {"technique", "", "category"}, {"difference from the true change", "%"}, names);
    for (const Measured* m : jobs) {
      std::vector<json> values;
      for (const std::string& name : names) {
        values.push_back(value(*m, name, "temporal/mean_difference_from_truth", 100.0));
        table.add({scene_label(*m), name, value(*m, name, "temporal/flips_a_thousand_pixel_steps"),
                   value(*m, name, "temporal/mean_change", 100.0), values.back()});
      }
      plot["series"].push_back(series(scene_label(*m), std::move(values)));
      add_pictures(section, *m);
    }
    section["tables"].push_back(table.json());
    section["plots"].push_back(std::move(plot));
  }
  return section;
}

json peers_section(const Evidence& e) {
  json section = new_section(
      "peers", "Peers against the truth",
      {"Every technique on the same frames, judged by the same truth: rays from many points of each pixel "
       "to the light. The error is of the share of light in a pixel, |technique - truth|, on the mean over "
       "the pixels whose every ray meets a surface that could be lit, so that it is of shadow alone; in "
       "the tables of the scenes also over all pixels that see a surface. Leaks are the part that is too "
       "light, false shadow the part that is too dark. FLIP compares the shaded pictures with the truth's.",
       "32 samples of izb and 32 rays stand at the same points, on the plane of what the pixel's centre "
       "sees; the truth sees all of the pixel. So neither can be nearer to it than that model, and what "
       "tells them apart is izb's table and its insertion. Flat pixels are those whose neighbours all lie "
       "on their plane, where the model holds. Elsewhere samples of the plane may lie inside of what else is "
       "in the pixel, and be dark; a map's bias forgives that, and may come nearer to the truth for it. "
       "Where the occluders are finer than 32 samples tell, as leaves are, what is left over flat pixels "
       "is the samples' own error, the same for rays.",
       "Bits unlike those of 32 rays leave all that out: the same points, the same question, other "
       "answers. There izb's is its table's quantisation; exact coverage leaves the samples that lie within "
       "the bias of a nearly coplanar neighbour (docs/VALIDATION.md)."});
  const std::vector<std::string> names = configuration_names(e.jobs);
  ReportTable summary("peers", "Median over the scenes",
                      {{.name = "technique", .text = true},
                       {.name = "error", .unit = "%", .digits = 3},
                       {.name = "error, flat pixels", .unit = "%", .digits = 3},
                       {.name = "leaks", .unit = "%", .digits = 3},
                       {.name = "false shadow", .unit = "%", .digits = 3},
                       {.name = "pixels wrong by more than 1/8", .unit = "%", .digits = 2},
                       {.name = "FLIP", .digits = 4},
                       {.name = "shadow stages", .unit = "ms"}});
  json plot = new_plot("peers-error", "bars", "Error of the share of light, median of the scenes",
                       {"technique", "", "category"}, {"error", "%"}, names);
  std::vector<json> errors;
  for (const std::string& name : names) {
    const auto over_scenes = [&](const std::string& what, double scale) {
      std::vector<json> cells;
      for (const Measured* m : e.jobs) cells.push_back(value(*m, name, what, scale));
      return median_of(cells);
    };
    errors.push_back(over_scenes("error/inner/mean", 100.0));
    summary.add({name, errors.back(), over_scenes("error/flat/mean", 100.0), over_scenes("error/inner/leaks", 100.0),
                 over_scenes("error/inner/false_shadow", 100.0),
                 over_scenes("error/inner/pixels_above_an_eighth", 100.0), over_scenes("flip_mean", 1.0),
                 over_scenes("shadow_ms", 1.0)});
  }
  plot["series"].push_back(series("error", errors));
  section["tables"].push_back(summary.json());
  section["plots"].push_back(std::move(plot));

  const std::string unlike = "bits unlike those of 32 rays at the same points";
  ReportTable verdicts("peers-verdicts", "32 samples of izb against 32 rays and against the best map, scene by scene",
                       {{.name = "scene", .text = true},
                        {.name = "izb, 32 samples", .unit = "%", .digits = 3, .group = "error"},
                        {.name = "32 rays", .unit = "%", .digits = 3, .group = "error"},
                        {.name = "izb, 1 sample", .unit = "%", .digits = 3, .group = "error"},
                        {.name = "best map", .unit = "%", .digits = 3, .group = "error"},
                        {.name = "which", .group = "error", .text = true},
                        {.name = "izb, 32 samples", .unit = "%", .digits = 3, .group = "error, flat pixels"},
                        {.name = "32 rays", .unit = "%", .digits = 3, .group = "error, flat pixels"},
                        {.name = "the best map there", .unit = "%", .digits = 3, .group = "error, flat pixels"},
                        {.name = "best map / izb", .digits = 1},
                        {.name = "izb, 32 samples", .unit = "%", .digits = 3, .group = unlike},
                        {.name = "izb, exact", .unit = "%", .digits = 5, .group = unlike},
                        {.name = "the best map of 32 samples", .unit = "%", .digits = 3, .group = unlike}});
  json by_scene = new_plot("peers-scenes", "bars", "Error of the share of light by scene", {"scene", "", "category"},
                           {"error", "%"}, scene_labels(e.jobs));
  std::vector<json> ours_by_scene, rays_by_scene, map_by_scene;
  for (const Measured* m : e.jobs) {
    const std::string map = best_map(*m);
    const json ours = role(*m, "ours", "error/inner/mean", 100.0), rays = role(*m, "rays", "error/inner/mean", 100.0),
               one = role(*m, "ours, 1 sample", "error/inner/mean", 100.0);
    const json its =
        map.empty() ? no_value(m->works() ? "no map worked" : m->reason()) : value(*m, map, "error/inner/mean", 100.0);
    verdicts.add({scene_label(*m), ours, rays, one, its, map.empty() ? its : json(map),
                  role(*m, "ours", "error/flat/mean", 100.0), role(*m, "rays", "error/flat/mean", 100.0),
                  map.empty() ? its : value(*m, best_map(*m, "error/flat/mean"), "error/flat/mean", 100.0),
                  ratio(its, ours), role(*m, "ours", unlike_rays), role(*m, "ours, exact", unlike_rays),
                  map.empty() ? its : bits_unlike_rays(*m, best_map(*m, unlike_rays))});
    ours_by_scene.push_back(ours), rays_by_scene.push_back(rays), map_by_scene.push_back(its);
    if (its.is_number() && ours.is_number() && its <= ours)
      section["notes"].push_back(
          fmt::format("{}: \"{}\" is {} the truth {} 32 samples of izb ({:.3f} and {:.3f} %); the pictures show where. "
                      "Over flat pixels: {} and {} %.",
                      scene_label(*m), map, its < ours ? "nearer to" : "as near to", its < ours ? "than" : "as",
                      its.get<double>(), ours.get<double>(), percent_text(value(*m, map, "error/flat/mean")),
                      percent_text(role(*m, "ours", "error/flat/mean"))));
  }
  by_scene["series"] = {series("izb, 32 samples", ours_by_scene), series("32 rays", rays_by_scene),
                        series("best map", map_by_scene)};
  section["tables"].push_back(verdicts.json());
  section["plots"].push_back(std::move(by_scene));

  ReportTable details("peers-all", "Every technique on every scene",
                      {{.name = "scene", .text = true},
                       {.name = "technique", .text = true},
                       {.name = "error", .unit = "%", .digits = 3, .group = "pixels that could be lit all over"},
                       {.name = "RMSE", .unit = "%", .digits = 2, .group = "pixels that could be lit all over"},
                       {.name = "leaks", .unit = "%", .digits = 3, .group = "pixels that could be lit all over"},
                       {.name = "false shadow", .unit = "%", .digits = 3, .group = "pixels that could be lit all over"},
                       {.name = "error", .unit = "%", .digits = 3, .group = "all pixels with a surface"},
                       {.name = "bits unlike those of 32 rays", .unit = "%", .digits = 4},
                       {.name = "FLIP", .digits = 4},
                       {.name = "shadow stages", .unit = "ms"},
                       {.name = "frame", .unit = "ms"}});
  for (const Measured* m : e.jobs) {
    for (const Configuration& c : m->job.configurations)
      details.add({scene_label(*m), c.name, value(*m, c.name, "error/inner/mean", 100.0),
                   value(*m, c.name, "error/inner/rmse", 100.0), value(*m, c.name, "error/inner/leaks", 100.0),
                   value(*m, c.name, "error/inner/false_shadow", 100.0), value(*m, c.name, "error/all/mean", 100.0),
                   bits_unlike_rays(*m, c.name), value(*m, c.name, "flip_mean"), value(*m, c.name, "shadow_ms"),
                   value(*m, c.name, "frame_ms")});
    add_pictures(section, *m);
  }
  section["tables"].push_back(details.json());
  return section;
}

}  // namespace izb::bench

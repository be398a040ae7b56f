// SPDX-License-Identifier: MIT
// izb validate: a technique's mask against rays from the same points, disputed bits settled exactly.
#include <CLI/CLI.hpp>
#include <optional>
#include <span>

#include "app/attribution.h"
#include "app/commands.h"
#include "app/results.h"
#include "app/verdict_picture.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/table.h"
#include "image/png.h"
#include "reference/embree.h"
#include "reference/model.h"
#include "reference/points.h"
#include "reference/settle.h"
#include "shadow/ray_traced/receivers.h"

namespace izb {
namespace {

constexpr double no_limit = 100.0;

struct ValidateOptions {
  FrameOptions frame;
  std::vector<std::string> scenes;
  std::string json, heatmap;
  bool points = true, model = false;
  double max_leak = no_limit;
  std::unique_ptr<Technique> technique;
  Arguments arguments;

  OptionSet options() {
    OptionSet set;
    set.text("json", json, "FILE", "write the table's numbers as JSON");
    set.text("heatmap", heatmap, "FILE",
             "write a picture of the verdicts as PNG: grey the mask, blue settled for the mask, yellow explained, red "
             "unexplained, magenta leaked by an approximate insertion, cyan wrong by a look-up table; with several "
             "scenes the stem of each is added to the name");
    set.flag("points", points, "also check the receiver points themselves");
    set.flag("model", model,
             "also compare each sample with a shadow ray from where its own camera ray hits: the error of the "
             "tangent-plane model");
    set.number("max-leak", max_leak, 0.0, no_limit, "percent",
               "the largest share of the shadowed bits that an approximate insertion may leak");
    return set;
  }
};

struct Outcome {
  std::string scene;
  nlohmann::json json;
};

std::string with_stem(const std::string& path, const std::string& stem) {
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{}{}", p.stem().string(), stem, p.extension().string())).string();
}

nlohmann::json settled_json(const reference::Settled& settled) {
  return {{"compared", settled.compared},
          {"lit", settled.lit},
          {"shadowed", settled.shadowed},
          {"disputed", settled.disputed},
          {"settled_ours", settled.settled_ours},
          {"explained", settled.explained},
          {"unexplained", settled.unexplained},
          {"leaks", settled.leaks},
          {"false_shadow", settled.false_shadow},
          {"left_out", {{"sky", settled.sky}, {"culled", settled.culled}, {"outside_cone", settled.outside_cone}}}};
}

nlohmann::json points_json(const reference::PointCheck& check, const std::string& scene_path) {
  if (check.wrong > 0)
    warn("{}: {} pixels see a wrong triangle, the first at pixel {}", scene_path, check.wrong,
         check.wrong_pixels.front());
  return {{"checked", check.checked},
          {"ok", check.ok},
          {"near_edge", check.near_edge},
          {"depth_tie", check.depth_tie},
          {"wrong", check.wrong},
          {"max_plane_ulps", check.max_plane_ulps},
          {"max_ray_offset_px", check.max_ray_offset_px}};
}

nlohmann::json attribution_json(const reference::Attribution& sums) {
  return {{"table", sums.table},
          {"insertion_leaks", sums.insertion_leaks},
          {"insertion_false", sums.insertion_false},
          {"shadowed_bits", sums.shadowed_bits},
          {"leak_percent", sums.leak_percent()}};
}

/// The first unexplained bits.
nlohmann::json records_json(const reference::Settled& settled, int width_px) {
  nlohmann::json records = nlohmann::json::array();
  for (const reference::DisputedBit& bit : settled.records) {
    if (bit.verdict != reference::Verdict::unexplained || records.size() == 20) break;
    records.push_back({{"x", bit.receiver % width_px},
                       {"y", bit.receiver / width_px},
                       {"sample", bit.sample},
                       {"leak", bit.leak},
                       {"edge_distance_bands", bit.edge_distance_bands}});
  }
  return records;
}

uint64_t shrunk_pixels(const reference::Receivers& receivers) {
  uint64_t shrunk = 0;
  for (size_t i = 0; i < receivers.count(); ++i)
    shrunk += receivers.classes[i] == reference::PixelClass::receiver && receivers.quad(i).shrink < 1.0;
  return shrunk;
}

Outcome validate_scene(const ValidateOptions& o, const std::string& scene_path) {
  FrameOptions frame = o.frame;
  // With several scenes each has its own view, named after its file.
  if (frame.viewpoint == "auto") frame.viewpoint = std::filesystem::path(scene_path).stem().string();
  Session s(frame, *o.technique, scene_path);
  s.renderer.render(s.frame.camera, s.frame.light, s.timers);
  s.timers.collect();
  const std::vector<uint32_t> asked = read_mask(s.renderer.mask());
  std::optional<reference::MaskTwins> twins;
  if (approximates(*o.technique)) twins = render_twins(s, *o.technique);
  // Only an exact mask has nothing but exact bits to explain.
  const std::vector<uint32_t>& mask = twins ? twins->exact : asked;
  const FrameInputs& in = s.renderer.inputs();
  const reference::Receivers receivers = make_receivers(read_gbuffer(*in.gbuffer), in);
  const reference::Triangles triangles{in.triangles_vs()};
  const reference::LightPoint light = make_light_point(in.light);
  const reference::PixelRays rays = reference::pixel_rays(s.frame.camera, in.width_px, in.height_px);

  Progress progress("building the ray tracer of " + scene_path, 4);
  const reference::RayTracer tracer(triangles);
  progress.advance();
  progress.relabel("tracing " + scene_path);
  const reference::MaskTrace traced = tracer.trace_mask(light, receivers);
  progress.advance();
  progress.relabel("settling disputed bits of " + scene_path);
  const reference::Settled settled = reference::settle(triangles, light, receivers, mask, traced.mask);
  progress.advance();
  progress.relabel("checking the points of " + scene_path);

  Outcome outcome{scene_path, provenance(s, frame, *o.technique, o.arguments, scene_path)};
  nlohmann::json& json = outcome.json;
  json["options"]["points"] = o.points;
  json["mask_hash"] = mask_hash(asked);
  json["pixels"] = mask.size();
  json["spp"] = receivers.sample_count();
  json["shrunk_pixels"] = shrunk_pixels(receivers);
  json.update(settled_json(settled));
  if (twins) json["attribution"] = attribution_json(reference::attribute(receivers, *twins));
  if (o.points) json["points"] = points_json(reference::check_points(tracer, triangles, rays, receivers), scene_path);
  if (o.model) {
    const reference::ModelError error = reference::compare_model(tracer, triangles, light, rays, receivers, mask);
    json["model"] = {{"compared", error.compared}, {"differing", error.differing}, {"percent", error.percent()}};
  }
  if (settled.unexplained > 0) json["records"] = records_json(settled, in.width_px);
  if (!o.heatmap.empty()) {
    const std::string path = o.scenes.size() > 1 ? with_stem(o.heatmap, s.scene.name) : o.heatmap;
    write_png(path, verdict_picture(receivers, settled, asked, twins ? &*twins : nullptr, s.frame.size));
  }
  progress.advance();
  return outcome;
}

/// One number of an outcome, by the path of its keys; empty where the outcome does not have it.
struct Shown {
  const char* heading;
  const char* path;
};

void print_table(const std::vector<Outcome>& outcomes) {
  std::vector<Shown> shown{{"pixels", "/pixels"},
                           {"spp", "/spp"},
                           {"shrunk", "/shrunk_pixels"},
                           {"lit", "/lit"},
                           {"shadowed", "/shadowed"},
                           {"disputed", "/disputed"},
                           {"settled_ours", "/settled_ours"},
                           {"explained", "/explained"},
                           {"unexplained", "/unexplained"},
                           {"leaks", "/leaks"},
                           {"false_shadow", "/false_shadow"},
                           {"sky", "/left_out/sky"},
                           {"culled", "/left_out/culled"},
                           {"outside cone", "/left_out/outside_cone"},
                           {"points wrong", "/points/wrong"}};
  // Columns that only some runs have.
  for (const Shown& more : std::initializer_list<Shown>{{"table", "/attribution/table"},
                                                        {"insertion leaks", "/attribution/insertion_leaks"},
                                                        {"insertion false", "/attribution/insertion_false"},
                                                        {"leak %", "/attribution/leak_percent"},
                                                        {"model %", "/model/percent"}})
    if (std::any_of(outcomes.begin(), outcomes.end(), [&](const Outcome& outcome) {
          return outcome.json.contains(nlohmann::json::json_pointer(more.path));
        }))
      shown.push_back(more);
  std::vector<Column> columns{{"scene", Align::left}};
  for (const Shown& column : shown) columns.push_back({column.heading});
  Table table(columns);
  for (const Outcome& outcome : outcomes) {
    std::vector<std::string> row{std::filesystem::path(outcome.scene).stem().string()};
    for (const Shown& column : shown) {
      const nlohmann::json value = outcome.json.value(nlohmann::json::json_pointer(column.path), nlohmann::json());
      row.push_back(value.is_null()           ? ""
                    : value.is_number_float() ? fmt::format("{:.4f}", value.get<double>())
                                              : json_text(value));
    }
    table.add_row(row);
  }
  fmt::print("{}", table.str());
}

/// Whether nothing is wrong but what an approximation that was asked for may be.
bool passes(const Outcome& outcome, double max_leak_percent) {
  const nlohmann::json& json = outcome.json;
  const bool leaks = json.contains("attribution") && json["attribution"]["leak_percent"] > max_leak_percent;
  if (leaks) warn("{}: the insertion leaks more than --max-leak {} percent", outcome.scene, max_leak_percent);
  return !leaks && json["unexplained"] == 0 && (!json.contains("points") || json["points"]["wrong"] == 0);
}

int validate(const ValidateOptions& o) {
  // Opened first: an output that cannot be written is known before the work.
  std::optional<AtomicFile> text;
  if (!o.json.empty()) text.emplace(o.json);
  std::vector<Outcome> outcomes;
  std::vector<std::string> failures;
  bool good = true;
  for (const std::string& scene : o.scenes) {
    try {
      outcomes.push_back(validate_scene(o, scene));
    } catch (const UsageError&) {
      throw;
    } catch (const Error& e) {
      failures.push_back(e.what());  // the others' results may take hours: they are not lost
      continue;
    }
    good &= passes(outcomes.back(), o.max_leak);
  }
  if (!outcomes.empty()) print_table(outcomes);
  std::fflush(stdout);
  for (const std::string& failure : failures) note("{}", failure);
  if (!failures.empty()) return 1;
  if (text) {
    nlohmann::json all = nlohmann::json::array();
    for (const Outcome& outcome : outcomes) all.push_back(outcome.json);
    const std::string json_file = json_text(all.size() == 1 ? all[0] : all, 1) + "\n";
    text->write(std::as_bytes(std::span(json_file)));
    text->commit();
  }
  return good ? 0 : 1;
}

}  // namespace

Command add_validate(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<ValidateOptions>();
  o->technique = technique_of(arguments);
  o->arguments = arguments;
  CLI::App* sub = app.add_subcommand("validate", "Compare a technique's mask with rays from the same points");
  sub->add_option("SCENE", o->scenes, "one or more .gltf or .glb files")->required();
  o->options().add_to(*sub, "Output");
  o->frame.options().add_to(*sub, "Frame");
  sub->get_option("--fov")->needs(sub->get_option("--eye"));
  o->technique->options().add_to(*sub, "Technique " + o->technique->info().name);
  sub->footer(
      "With --viewpoint auto each scene takes the view that is named after its file.\n"
      "At 32 samples a pixel with approximations the frame is rendered without them, too: wrong bits are attributed "
      "to\n"
      "the one that made them, and what remains must be explained.\n"
      "Exit code 1 if any bit is unexplained, any pixel sees a wrong triangle, or more than --max-leak leaks.");
  return [o] { return validate(*o); };
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// izb validate: a technique's mask against rays from the same points, disputed bits settled exactly.
#include <CLI/CLI.hpp>
#include <optional>
#include <span>

#include "app/commands.h"
#include "app/results.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/table.h"
#include "image/heat_map.h"
#include "image/png.h"
#include "reference/embree.h"
#include "reference/points.h"
#include "reference/settle.h"
#include "shadow/ray_traced/receivers.h"

namespace izb {
namespace {

struct ValidateOptions {
  FrameOptions frame;
  std::vector<std::string> scenes;
  std::string json, heatmap;
  bool points = true;
  std::unique_ptr<Technique> technique;
  Arguments arguments;

  OptionSet options() {
    OptionSet set;
    set.text("json", json, "FILE", "write the table's numbers as JSON");
    set.text("heatmap", heatmap, "FILE",
             "write a picture of the verdicts as PNG: grey the mask, blue settled for the mask, yellow explained, red "
             "unexplained; with several scenes the stem of each is added to the name");
    set.flag("points", points, "also check the receiver points themselves");
    return set;
  }
};

struct Outcome {
  std::string scene;
  nlohmann::json json;
};

Image8 verdict_picture(const reference::Settled& settled, const std::vector<uint32_t>& mask, Size size) {
  Image8 picture{size.width_px, size.height_px, 3, {}};
  for (size_t i = 0; i < mask.size(); ++i) {
    std::array<uint8_t, 3> color = mask[i] ? std::array<uint8_t, 3>{70, 70, 70} : std::array<uint8_t, 3>{170, 170, 170};
    switch (settled.verdicts[i]) {
      case reference::Verdict::not_compared:
        color = {120, 120, 120};
        break;
      case reference::Verdict::settled_ours:
        color = {60, 90, 255};
        break;
      case reference::Verdict::explained:
        color = {255, 220, 0};
        break;
      case reference::Verdict::unexplained:
        color = {255, 0, 0};
        break;
      case reference::Verdict::agreed:
        break;
    }
    picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
  }
  return picture;
}

std::string with_stem(const std::string& path, const std::string& stem) {
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{}{}", p.stem().string(), stem, p.extension().string())).string();
}

Outcome validate_scene(const ValidateOptions& o, const std::string& scene_path) {
  FrameOptions frame = o.frame;
  // With several scenes each has its own view, named after its file.
  if (frame.viewpoint == "auto") frame.viewpoint = std::filesystem::path(scene_path).stem().string();
  Session s(frame, *o.technique, scene_path);
  s.renderer.render(s.frame.camera, s.frame.light, s.timers);
  s.timers.collect();
  const FrameInputs& in = s.renderer.inputs();
  const std::vector<uint32_t> mask = read_mask(s.renderer.mask());
  const reference::Receivers receivers = make_receivers(read_gbuffer(*in.gbuffer), in);
  const reference::Triangles triangles{in.triangles_vs()};
  const reference::LightPoint light = make_light_point(in.light);

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
  outcome.json["options"]["points"] = o.points;
  outcome.json["mask_hash"] = mask_hash(mask);
  outcome.json["pixels"] = mask.size();
  outcome.json["compared"] = settled.compared;
  outcome.json["lit"] = settled.lit;
  outcome.json["shadowed"] = settled.shadowed;
  outcome.json["disputed"] = settled.disputed;
  outcome.json["settled_ours"] = settled.settled_ours;
  outcome.json["explained"] = settled.explained;
  outcome.json["unexplained"] = settled.unexplained;
  outcome.json["leaks"] = settled.leaks;
  outcome.json["false_shadow"] = settled.false_shadow;
  outcome.json["left_out"] = {{"sky", settled.sky}, {"culled", settled.culled}, {"outside_cone", settled.outside_cone}};
  if (o.points) {
    reference::PixelRays rays = reference::pixel_rays(s.frame.camera, in.width_px, in.height_px);
    const reference::PointCheck check = reference::check_points(tracer, triangles, rays, receivers);
    outcome.json["points"] = {{"checked", check.checked},
                              {"ok", check.ok},
                              {"near_edge", check.near_edge},
                              {"depth_tie", check.depth_tie},
                              {"wrong", check.wrong},
                              {"max_plane_ulps", check.max_plane_ulps},
                              {"max_ray_offset_px", check.max_ray_offset_px}};
    if (check.wrong > 0)
      warn("{}: {} pixels see a wrong triangle, the first at pixel {}", scene_path, check.wrong,
           check.wrong_pixels.front());
  }
  for (const reference::DisputedBit& bit : settled.records) {
    if (bit.verdict != reference::Verdict::unexplained) break;
    outcome.json["records"].push_back({{"x", bit.receiver % in.width_px},
                                       {"y", bit.receiver / in.width_px},
                                       {"leak", bit.leak},
                                       {"edge_distance_bands", bit.edge_distance_bands}});
    if (outcome.json["records"].size() == 20) break;
  }
  if (!o.heatmap.empty()) {
    const std::string path = o.scenes.size() > 1 ? with_stem(o.heatmap, s.scene.name) : o.heatmap;
    write_png(path, verdict_picture(settled, mask, s.frame.size));
  }
  progress.advance();
  return outcome;
}

void print_table(const std::vector<Outcome>& outcomes) {
  const std::vector<const char*> keys{"pixels",    "lit",         "shadowed", "disputed",    "settled_ours",
                                      "explained", "unexplained", "leaks",    "false_shadow"};
  std::vector<Column> columns{{"scene", Align::left}};
  for (const char* key : keys) columns.push_back({key});
  for (const char* key : {"sky", "culled", "outside cone", "points wrong"}) columns.push_back({key});
  Table table(columns);
  for (const Outcome& outcome : outcomes) {
    std::vector<std::string> row{std::filesystem::path(outcome.scene).stem().string()};
    for (const char* key : keys) row.push_back(outcome.json[key].dump());
    for (const char* key : {"sky", "culled", "outside_cone"}) row.push_back(outcome.json["left_out"][key].dump());
    row.push_back(outcome.json.contains("points") ? outcome.json["points"]["wrong"].dump() : "");
    table.add_row(row);
  }
  fmt::print("{}", table.str());
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
    const nlohmann::json& json = outcomes.back().json;
    good &= json["unexplained"] == 0 && (!json.contains("points") || json["points"]["wrong"] == 0);
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
      "Exit code 1 if any bit is unexplained or any pixel sees a wrong triangle.");
  return [o] { return validate(*o); };
}

}  // namespace izb

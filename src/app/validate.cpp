// SPDX-License-Identifier: MIT
// izb validate: a technique's mask against rays from the same points, disputed bits settled exactly.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <span>

#include "app/attribution.h"
#include "app/commands.h"
#include "app/outputs.h"
#include "app/results.h"
#include "app/validate_report.h"
#include "app/verdict_picture.h"
#include "base/error.h"
#include "base/json_text.h"
#include "base/log.h"
#include "base/progress.h"
#include "image/picture.h"
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
             "unexplained, magenta leaked by an approximate insertion, cyan wrong by a look-up table, green by alpha "
             "asked once a fragment or "
             "within its error; with several "
             "scenes the stem of each is added to the name, of several lights the pictures stand side by side");
    set.flag("points", points, "also check the receiver points themselves");
    set.flag("model", model,
             "also compare each sample with a shadow ray from where its own camera ray hits: the error of the "
             "tangent-plane model");
    set.number("max-leak", max_leak, 0.0, no_limit, "percent",
               "the largest share of the shadowed bits that an approximate insertion may leak");
    return set;
  }
};

std::string stem(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

uint64_t shrunk_pixels(const reference::Receivers& receivers) {
  uint64_t shrunk = 0;
  for (size_t i = 0; i < receivers.count(); ++i)
    shrunk += receivers.classes[i] == reference::PixelClass::receiver && receivers.quad(i).shrink < 1.0;
  return shrunk;
}

/// What the masks of one frame are compared with, whichever the light.
struct Truth {
  GBufferImage gbuffer;
  reference::Triangles triangles;
  reference::PixelRays rays;
  reference::RayTracer tracer;

  explicit Truth(const Session& s)
      : gbuffer(read_gbuffer(*s.renderer.inputs().gbuffer)),
        triangles(make_triangles(s.renderer.inputs())),
        rays(reference::pixel_rays(s.frame.camera, s.frame.size.width_px, s.frame.size.height_px)),
        tracer(triangles) {}
};

/// A light's mask as asked for, and with the approximations turned off, where there are any.
struct Masks {
  std::vector<uint32_t> asked;
  std::optional<reference::MaskTwins> twins;
};

std::vector<Masks> render_masks(Session& s) {
  s.renderer.render(s.frame.camera, s.frame.lights, s.timers);
  s.timers.collect();
  std::vector<Masks> masks(s.renderer.light_count());
  for (size_t i = 0; i < masks.size(); ++i) masks[i].asked = s.renderer.read_mask(i);
  if (!approximates(s, *s.technique)) return masks;
  std::vector<reference::MaskTwins> twins = render_twins(s, *s.technique);
  for (size_t i = 0; i < masks.size(); ++i) masks[i].twins = std::move(twins[i]);
  return masks;
}

/// Compares the mask of one light; `json` is what is known already. The points are the same under all lights, and
/// checked with the first.
nlohmann::json validate_light(const ValidateOptions& o, const Session& s, const Truth& truth, size_t light,
                              const Masks& masks, nlohmann::json json, Image8* heatmap, Progress& progress) {
  const std::string& file = json["scene"]["file"].get_ref<const std::string&>();
  const FrameInputs& in = s.renderer.inputs(light);
  // Only an exact mask has nothing but exact bits to explain.
  const std::vector<uint32_t>& mask = masks.twins ? masks.twins->exact : masks.asked;
  const reference::Receivers receivers = make_receivers(truth.gbuffer, in);
  const reference::LightPoint its = make_light_point(in.light);
  progress.relabel("tracing " + file);
  const reference::MaskTrace traced = truth.tracer.trace_mask(its, receivers);
  progress.advance();
  progress.relabel("settling disputed bits of " + file);
  const reference::Settled settled = reference::settle(truth.triangles, its, receivers, mask, traced.mask);
  progress.advance();
  progress.relabel("checking the points of " + file);

  json["light"] = {{"name", s.frame.lights[light].name}, {"type", type_name(s.frame.lights[light].type)}};
  json["mask_hash"] = mask_hash({&masks.asked, 1});
  json["pixels"] = mask.size();
  json["spp"] = receivers.sample_count();
  json["shrunk_pixels"] = shrunk_pixels(receivers);
  json.update(settled_json(settled));
  if (masks.twins) json["attribution"] = attribution_json(reference::attribute(receivers, *masks.twins));
  if (o.points && light == 0) {
    const reference::PointCheck check = reference::check_points(truth.tracer, truth.triangles, truth.rays, receivers);
    if (check.wrong > 0)
      warn("{}: {} pixels see a wrong triangle, the first at pixel {}", file, check.wrong, check.wrong_pixels.front());
    json["points"] = points_json(check);
  }
  if (o.model)
    json["model"] =
        model_json(reference::compare_model(truth.tracer, truth.triangles, its, truth.rays, receivers, mask));
  if (settled.unexplained > 0) json["records"] = records_json(settled, in.width_px);
  if (heatmap)
    *heatmap = verdict_picture(receivers, settled, masks.asked, masks.twins ? &*masks.twins : nullptr, s.frame.size);
  progress.advance();
  return json;
}

/// One report a light. `heatmap` may be null.
std::vector<SceneReport> validate_scene(const ValidateOptions& o, const std::string& scene_path, AtomicFile* heatmap) {
  FrameOptions frame = o.frame;
  // With several scenes each has its own view, named after its file.
  if (frame.viewpoint == "auto") frame.viewpoint = stem(scene_path);
  Session s(frame, another(*o.technique), scene_path);
  const std::vector<Masks> masks = render_masks(s);
  nlohmann::json json = provenance(s.rendered(), frame, o.arguments, scene_path);
  json["options"]["points"] = o.points;
  json.update(memory_json(s.renderer));
  if (s.renderer.scene_buffers().deforms())
    json["deformation"] = deformation_json(check_deformation(s.scene, s.renderer.scene_buffers()));

  Progress progress("building the ray tracer of " + scene_path, 1 + 3 * masks.size());
  const Truth truth(s);
  progress.advance();
  std::vector<SceneReport> reports;
  std::vector<Image8> pictures(masks.size());
  for (size_t i = 0; i < masks.size(); ++i) {
    const std::string label = stem(scene_path) + (masks.size() > 1 ? " " + s.frame.lights[i].name : "");
    reports.push_back({scene_path, label,
                       validate_light(o, s, truth, i, masks[i], json, heatmap ? &pictures[i] : nullptr, progress)});
  }
  if (heatmap) write_png(*heatmap, side_by_side(pictures, 4, {0, 0, 0}));
  return reports;
}

/// Whether nothing is wrong but what an approximation that was asked for may be.
bool passes(const SceneReport& report, double max_leak_percent) {
  const nlohmann::json& json = report.json;
  const bool leaks = json.contains("attribution") && json["attribution"]["leak_percent"] > max_leak_percent;
  if (leaks) warn("{}: the insertion leaks more than --max-leak {} percent", report.scene, max_leak_percent);
  const bool misplaced =
      json.contains("deformation") && (json["deformation"]["wrong"] != 0 || json["deformation"]["not_as_on_cpu"] != 0);
  if (misplaced) warn("{}: deformed vertices are not where double precision puts them", report.scene);
  return !leaks && !misplaced && json["unexplained"] == 0 && (!json.contains("points") || json["points"]["wrong"] == 0);
}

/// One of each scene, null where none is asked for; with several scenes the stem of each is in its name.
std::vector<AtomicFile*> open_heatmaps(Outputs& outputs, const ValidateOptions& o) {
  if (o.heatmap.empty() || o.scenes.size() == 1)
    return std::vector<AtomicFile*>(o.scenes.size(), outputs.open("--heatmap", o.heatmap));
  std::vector<AtomicFile*> heatmaps;
  for (const std::string& scene : o.scenes) {
    std::filesystem::path path(o.heatmap);
    path.replace_filename(fmt::format("{}.{}{}", path.stem().string(), stem(scene), path.extension().string()));
    heatmaps.push_back(outputs.open("the --heatmap of " + scene, path.string()));
  }
  return heatmaps;
}

int validate(const ValidateOptions& o) {
  Outputs outputs;
  AtomicFile* const text = outputs.open("--json", o.json);
  const std::vector<AtomicFile*> heatmaps = open_heatmaps(outputs, o);
  std::vector<SceneReport> reports;
  std::vector<std::string> failures;
  bool good = true;
  for (size_t i = 0; i < o.scenes.size(); ++i) {
    try {
      for (SceneReport& report : validate_scene(o, o.scenes[i], heatmaps[i])) {
        good &= passes(report, o.max_leak);
        reports.push_back(std::move(report));
      }
    } catch (const UsageError&) {
      throw;
    } catch (const Error& e) {
      failures.push_back(e.what());  // the others' results may take hours: they are not lost
      continue;
    }
  }
  if (!reports.empty()) print_table(reports);
  for (const SceneReport& report : reports) fmt::print("{}: {}\n", report.label, memory_line(report.json));
  std::fflush(stdout);
  for (const std::string& failure : failures) note("{}", failure);
  if (!failures.empty()) return 1;
  if (text) {
    nlohmann::json all = nlohmann::json::array();
    for (const SceneReport& report : reports) all.push_back(report.json);
    const std::string json_file = json_text(all.size() == 1 ? all[0] : all, 1) + "\n";
    text->write(std::as_bytes(std::span(json_file)));
  }
  outputs.commit();
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
      "Exit code 1 if any bit is unexplained, any pixel sees a wrong triangle, any deformed vertex is elsewhere than "
      "double\n"
      "precision puts it, or more than --max-leak leaks.");
  return [o] { return validate(*o); };
}

}  // namespace izb

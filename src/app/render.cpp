// SPDX-License-Identifier: MIT
// izb render: one frame, or each of a sequence, as OpenEXR, PNG and JSON.
#include <CLI/CLI.hpp>
#include <chrono>
#include <span>

#include "app/commands.h"
#include "app/outputs.h"
#include "app/peer.h"
#include "app/results.h"
#include "app/sequence.h"
#include "app/session.h"
#include "app/statistics.h"
#include "base/error.h"
#include "base/json_text.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/table.h"
#include "frame/read_back.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"

namespace izb {
namespace {

struct RenderOptions {
  FrameOptions frame;
  std::string scene, output, preview, json;
  int repeat = 1;
  bool peer = false;
  SequenceOptions sequence;
  std::unique_ptr<Technique> technique;
  Arguments arguments;

  OptionSet options() {
    OptionSet set;
    set.text("preview", preview, "FILE", "also write the picture as PNG");
    set.text("json", json, "FILE", "also write times, counts, memory and the mask's hash as JSON");
    set.integer("repeat", repeat, 1, 10000, "frames", "frames to time; medians are reported");
    set.flag("peer", peer, "alternate each frame with Embree on the same cores and report its times");
    sequence.declare(set);
    return set;
  }
};

struct Timed {
  std::vector<double> frame_ms;
  nlohmann::json peer;
};

/// One frame unmeasured: the driver compiles on first use.
void warm_up(Session& s) {
  gpu::StageTimers unmeasured(s.timers.wall_clock());
  s.renderer.render(s.frame.camera, s.frame.lights, unmeasured);
  glFinish();
  unmeasured.collect();
}

Timed render_frames(Session& s, const RenderOptions& o) {
  const FrameChoice& f = s.frame;
  s.timers.clear();
  std::unique_ptr<Peer> peer;
  if (o.peer) peer = std::make_unique<Peer>(s.renderer);
  Timed timed;
  Progress progress("rendering", static_cast<uint64_t>(o.repeat));
  for (int i = 0; i < o.repeat; ++i) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    s.renderer.render(f.camera, f.lights, s.timers);
    glFinish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    timed.frame_ms.push_back(elapsed.count());
    s.timers.collect();
    if (peer) peer->run();
    progress.advance();
  }
  if (peer) timed.peer = peer->to_json();
  return timed;
}

void print_table(const nlohmann::json& json) {
  Table stages({{"stage", Align::left}, {"ms"}});
  for (const auto& stage : json["stages"])
    stages.add_row({stage["name"].get<std::string>(), fmt::format("{:.2f}", stage["gpu_ms"].get<double>())});
  stages.add_row({"frame", fmt::format("{:.2f}", json["frame_ms"].get<double>())});
  fmt::print("{}\n", stages.str());
  Table counts({{"count", Align::left}, {"value"}});
  for (const auto& [name, value] : json["counts"].items()) counts.add_row({name, json_text(value)});
  for (const auto& [name, value] : json["averages"].items())
    counts.add_row({name, fmt::format("{:.2f}", value.get<double>())});
  fmt::print("{}\n{}\n", counts.str(), memory_line(json));
}

/// What a frame is, before it is rendered.
nlohmann::json facts_of(Session& s, RenderOptions& o, std::optional<int> frame) {
  nlohmann::json json = provenance(s.rendered(), o.frame, o.arguments, o.scene);
  json["options"].update(o.options().to_json());
  if (frame) json["frame"] = *frame;
  if (frame || o.frame.plays()) json["time_s"] = s.moment.time_s;
  return json;
}

/// Where one frame goes; null: not asked for.
struct FrameFiles {
  Outputs outputs;
  AtomicFile *exr, *png, *text;

  FrameFiles(const std::string& exr_path, const std::string& png_path, const std::string& json_path)
      : exr(outputs.open("--output", exr_path)),
        png(outputs.open("--preview", png_path)),
        text(outputs.open("--json", json_path)) {}
};

/// Renders the frame where the session stands, and writes it. Returns its JSON.
nlohmann::json write_frame(Session& s, const RenderOptions& o, nlohmann::json json, FrameFiles& files) {
  const Timed timed = render_frames(s, o);
  json.update(masks_json(s.rendered()));
  json["stages"] = stages_json(s.timers);
  json["frame_ms"] = median(timed.frame_ms);
  json.update(memory_json(s.renderer));
  if (!timed.peer.is_null()) json["peer"] = timed.peer;
  const Image image = frame_image(s.rendered(), json);
  add_statistics(json, s.rendered());
  const std::vector<float>& depth = image.floats("depth");
  if (std::none_of(depth.begin(), depth.end(), [](float d) { return d > 0.0f; }))
    warn("no triangle of '{}' is in view: the picture shows the sky", o.scene);
  if (files.exr) write_exr(*files.exr, image);
  if (files.png) write_png(*files.png, preview(image));
  const std::string json_file = json_text(json, 1) + "\n";
  if (files.text) files.text->write(std::as_bytes(std::span(json_file)));
  files.outputs.commit();
  return json;
}

int render_one(RenderOptions& o) {
  FrameFiles files(o.output, o.preview, o.json);
  Session s(o.frame, std::move(o.technique), o.scene);
  warm_up(s);
  print_table(write_frame(s, o, facts_of(s, o, {}), files));
  for (const AtomicFile& file : files.outputs.files()) fmt::print("wrote {}\n", file.target().string());
  return 0;
}

int render_sequence(RenderOptions& o, const FrameRange& range) {
  if (o.sequence.resume && o.output.empty() && o.json.empty())
    throw UsageError("--resume needs -o or --json: a PNG does not say what it was made with");
  const double start_s = std::max(o.frame.time_s, 0.0);
  const auto moment_s = [&](int frame) { return start_s + frame / o.sequence.fps; };
  if (!o.frame.plays()) o.frame.time_s = 0.0;
  // Whether they can be written is known before the work begins.
  FrameFiles(numbered(o.output, range.first), numbered(o.preview, range.first), numbered(o.json, range.first));
  Session s(o.frame, std::move(o.technique), o.scene);
  bool warm = false;
  for (int n = range.first; n <= range.last; ++n) {
    const std::string exr = numbered(o.output, n), png = numbered(o.preview, n), json = numbered(o.json, n);
    s.move_to(moment_s(n));
    const nlohmann::json facts = facts_of(s, o, n);
    const auto there = [&](const std::string& path) { return path.empty() || is_rendered(path, facts); };
    if (o.sequence.resume && there(exr) && there(json) && (png.empty() || std::filesystem::exists(png))) continue;
    FrameFiles files(exr, png, json);
    if (!warm) warm_up(s);
    warm = true;
    const nlohmann::json written = write_frame(s, o, facts, files);
    std::string names;
    for (const AtomicFile& file : files.outputs.files()) names += " " + file.target().string();
    fmt::print("frame {} ({:.3f} s): {:.1f} ms, wrote{}\n", n, s.moment.time_s, written["frame_ms"].get<double>(),
               names);
    std::fflush(stdout);
  }
  if (!warm) note("all frames were there already");
  return 0;
}

int render(RenderOptions& o) {
  if (o.output.empty() && o.preview.empty() && o.json.empty())
    throw UsageError("nothing to write: give -o FILE.exr, --preview FILE.png or --json FILE.json");
  const std::optional<FrameRange> range = frame_range(o.sequence);
  return range ? render_sequence(o, *range) : render_one(o);
}

}  // namespace

Command add_render(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<RenderOptions>();
  o->technique = technique_of(arguments);
  o->arguments = arguments;
  CLI::App* sub = app.add_subcommand("render", "Render one frame of a glTF scene, or each of an animation");
  sub->add_option("SCENE", o->scene, "a .gltf or .glb file")->required();
  sub->add_option("-o,--output", o->output, "write the frame as OpenEXR")->type_name("FILE");
  o->options().add_to(*sub, "Output");
  o->frame.options().add_to(*sub, "Frame");
  sub->get_option("--fov")->needs(sub->get_option("--eye"));
  o->technique->options().add_to(*sub, "Technique " + o->technique->info().name);
  return [o] { return render(*o); };
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// izb render: one frame, or each of a sequence, as OpenEXR, PNG and JSON.
#include <CLI/CLI.hpp>
#include <chrono>
#include <limits>
#include <span>

#include "app/commands.h"
#include "app/outputs.h"
#include "app/peer.h"
#include "app/results.h"
#include "app/sequence.h"
#include "app/session.h"
#include "app/statistics.h"
#include "app/supersample.h"
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
  int supersample = 0;
  double checkpoint_s = 30.0;
  SequenceOptions sequence;
  std::unique_ptr<Technique> technique;
  Arguments arguments;

  OptionSet options() {
    OptionSet set;
    set.text("preview", preview, "FILE", "also write the picture as PNG");
    set.text("json", json, "FILE", "also write times, counts, memory and the mask's hash as JSON");
    set.integer("repeat", repeat, 1, 10000, "frames", "frames to time; medians are reported");
    set.flag("peer", peer, "alternate each frame with Embree on the same cores and report its times");
    set.integer("supersample", supersample, 0, largest_supersample, "frames",
                "the mean of so many frames, each through another point of its pixels, as OpenEXR with shares of what "
                "is lit; 0: one frame through the pixels' centres");
    set.number("checkpoint", checkpoint_s, 0.0, std::numeric_limits<double>::infinity(), "seconds",
               "with --supersample: how often the file of -o is written meanwhile, for --resume");
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
  if (!json["frame_ms"].is_null()) stages.add_row({"frame", fmt::format("{:.2f}", json["frame_ms"].get<double>())});
  fmt::print("{}\n", stages.str());
  Table counts({{"count", Align::left}, {"value"}});
  if (json.contains("supersample")) counts.add_row({"supersample", json_text(json["supersample"])});
  // Of a supersampled frame there are none.
  for (const char* group : {"counts", "averages"}) {
    if (!json.contains(group)) continue;
    for (const auto& [name, value] : json[group].items())
      counts.add_row({name, value.is_number_float() ? fmt::format("{:.2f}", value.get<double>()) : json_text(value)});
  }
  fmt::print("{}\n{}\n", counts.str(), memory_line(json));
}

/// What a frame is, before it is rendered.
nlohmann::json facts_of(Session& s, RenderOptions& o, std::optional<int> frame) {
  nlohmann::json json = provenance(s.rendered(), o.frame, o.arguments, o.scene);
  json["options"].update(o.options().to_json());
  if (frame) json["frame"] = *frame;
  if (frame || o.frame.plays()) json["time_s"] = s.moment.time_s;
  if (o.supersample > 0) json["supersample"] = o.supersample;
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

void warn_if_empty(bool any_surface, const std::string& scene) {
  if (!any_surface) warn("no triangle of '{}' is in view: the picture shows the sky", scene);
}

void write_files(FrameFiles& files, const Image& image, const nlohmann::json& json) {
  if (files.exr) write_exr(*files.exr, image);
  if (files.png) write_png(*files.png, preview(image));
  const std::string json_file = json_text(json, 1) + "\n";
  if (files.text) files.text->write(std::as_bytes(std::span(json_file)));
  files.outputs.commit();
}

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
  warn_if_empty(std::any_of(depth.begin(), depth.end(), [](float d) { return d > 0.0f; }), o.scene);
  write_files(files, image, json);
  return json;
}

/// The same for the mean of many frames; `exr_path` is for what lies there meanwhile.
nlohmann::json write_supersampled(Session& s, const RenderOptions& o, const nlohmann::json& facts, FrameFiles& files,
                                  const std::string& exr_path) {
  Accumulated sums;
  if (o.sequence.resume) sums = resumed_sums(s, exr_path, facts);
  s.timers.clear();
  std::vector<double> frame_ms;
  Progress progress("rendering", static_cast<uint64_t>(o.supersample - sums.frames));
  AccumulateSteps steps;
  steps.frame = [&](double ms) {
    frame_ms.push_back(ms);
    progress.advance();
  };
  // A device or a pipe takes one image, the last.
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(exr_path, ignored);
  if (files.exr && (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status))) {
    steps.checkpoint_s = o.checkpoint_s;
    steps.checkpoint = [&](const Accumulated& held) {
      write_exr(exr_path,
                supersampled_image(s.rendered(), held, supersampled_facts(s.rendered(), held, frame_ms, facts)));
    };
  }
  accumulate(s, sums, o.supersample, steps);
  const nlohmann::json json = supersampled_facts(s.rendered(), sums, frame_ms, facts);
  warn_if_empty(std::any_of(sums.surface.begin(), sums.surface.end(), [](uint32_t n) { return n > 0; }), o.scene);
  write_files(files, supersampled_image(s.rendered(), sums, json), json);
  return json;
}

/// Either; returns the frame's JSON.
nlohmann::json write(Session& s, const RenderOptions& o, const nlohmann::json& facts, FrameFiles& files,
                     const std::string& exr_path) {
  return o.supersample > 0 ? write_supersampled(s, o, facts, files, exr_path) : write_frame(s, o, facts, files);
}

/// Whether all files that are asked for hold the frame already.
bool all_there(const std::string& exr, const std::string& png, const std::string& json, const nlohmann::json& facts) {
  const auto there = [&](const std::string& path) { return path.empty() || is_rendered(path, facts); };
  return there(exr) && there(json) && (png.empty() || std::filesystem::exists(png));
}

int render_one(RenderOptions& o) {
  FrameFiles files(o.output, o.preview, o.json);
  Session s(o.frame, std::move(o.technique), o.scene);
  const nlohmann::json facts = facts_of(s, o, {});
  if (o.sequence.resume && all_there(o.output, o.preview, o.json, facts)) {
    note("all {} frames were there already", o.supersample);
    return 0;
  }
  if (o.supersample == 0) warm_up(s);
  print_table(write(s, o, facts, files, o.output));
  for (const AtomicFile& file : files.outputs.files()) fmt::print("wrote {}\n", file.target().string());
  return 0;
}

int render_sequence(RenderOptions& o, const FrameRange& range) {
  const double start_s = std::max(o.frame.time_s, 0.0);
  const auto moment_s = [&](int frame) { return start_s + frame / o.sequence.fps; };
  if (!o.frame.plays()) o.frame.time_s = 0.0;
  // Whether they can be written is known before the work begins.
  FrameFiles(numbered(o.output, range.first), numbered(o.preview, range.first), numbered(o.json, range.first));
  Session s(o.frame, std::move(o.technique), o.scene);
  bool any = false;
  for (int n = range.first; n <= range.last; ++n) {
    const std::string exr = numbered(o.output, n), png = numbered(o.preview, n), json = numbered(o.json, n);
    s.move_to(moment_s(n));
    const nlohmann::json facts = facts_of(s, o, n);
    if (o.sequence.resume && all_there(exr, png, json, facts)) continue;
    FrameFiles files(exr, png, json);
    if (!any && o.supersample == 0) warm_up(s);
    any = true;
    const nlohmann::json written = write(s, o, facts, files, exr);
    std::string names;
    for (const AtomicFile& file : files.outputs.files()) names += " " + file.target().string();
    const nlohmann::json& ms = written["frame_ms"];
    fmt::print("frame {} ({:.3f} s): {}wrote{}\n", n, s.moment.time_s,
               ms.is_null() ? "" : fmt::format("{:.1f} ms, ", ms.get<double>()), names);
    std::fflush(stdout);
  }
  if (!any) note("all frames were there already");
  return 0;
}

/// Throws izb::UsageError for options that exclude each other or need another.
void check(const RenderOptions& o, bool sequence) {
  if (o.output.empty() && o.preview.empty() && o.json.empty())
    throw UsageError("nothing to write: give -o FILE.exr, --preview FILE.png or --json FILE.json");
  if (o.supersample > 0 && (o.repeat > 1 || o.peer))
    throw UsageError("--supersample renders each of its frames once: --repeat and --peer do not go with it");
  if (!o.sequence.resume) return;
  if (!sequence && o.supersample == 0) throw UsageError("--resume goes with --frames or --supersample");
  if (o.supersample > 0 && o.output.empty())
    throw UsageError("--resume needs -o with --supersample: only the OpenEXR file holds the sums");
  if (o.output.empty() && o.json.empty())
    throw UsageError("--resume needs -o or --json: a PNG does not say what it was made with");
}

int render(RenderOptions& o) {
  const std::optional<FrameRange> range = frame_range(o.sequence);
  check(o, range.has_value());
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

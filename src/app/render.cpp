// SPDX-License-Identifier: MIT
// izb render: one frame as OpenEXR, PNG and JSON.
#include <CLI/CLI.hpp>
#include <chrono>
#include <span>

#include "app/commands.h"
#include "app/outputs.h"
#include "app/peer.h"
#include "app/results.h"
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
  std::unique_ptr<Technique> technique;
  Arguments arguments;

  OptionSet options() {
    OptionSet set;
    set.text("preview", preview, "FILE", "also write the picture as PNG");
    set.text("json", json, "FILE", "also write times, counts, memory and the mask's hash as JSON");
    set.integer("repeat", repeat, 1, 10000, "frames", "frames to time; medians are reported");
    set.flag("peer", peer, "alternate each frame with Embree on the same cores and report its times");
    return set;
  }
};

struct Timed {
  std::vector<double> frame_ms;
  nlohmann::json peer;
};

Timed render_frames(Session& s, const RenderOptions& o) {
  const FrameChoice& f = s.frame;
  // One frame unmeasured: the driver compiles on first use.
  gpu::StageTimers warm_up(s.timers.wall_clock());
  s.renderer.render(f.camera, f.lights, warm_up);
  glFinish();
  warm_up.collect();
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

int render(RenderOptions& o) {
  if (o.output.empty() && o.preview.empty() && o.json.empty())
    throw UsageError("nothing to write: give -o FILE.exr, --preview FILE.png or --json FILE.json");
  Outputs outputs;
  AtomicFile* const exr = outputs.open("--output", o.output);
  AtomicFile* const png = outputs.open("--preview", o.preview);
  AtomicFile* const text = outputs.open("--json", o.json);
  Session s(o.frame, std::move(o.technique), o.scene);
  const Timed timed = render_frames(s, o);

  nlohmann::json json = provenance(s, o.frame, *s.technique, o.arguments, o.scene);
  json["options"].update(o.options().to_json());
  json.update(masks_json(s));
  json["stages"] = stages_json(s.timers);
  json["frame_ms"] = median(timed.frame_ms);
  json.update(memory_json(s.renderer));
  if (!timed.peer.is_null()) json["peer"] = timed.peer;
  const Image image = frame_image(s, json);
  add_statistics(json, s);
  const std::vector<float>& depth = image.floats("depth");
  if (std::none_of(depth.begin(), depth.end(), [](float d) { return d > 0.0f; }))
    warn("no triangle of '{}' is in view: the picture shows the sky", o.scene);

  if (exr) write_exr(*exr, image);
  if (png) write_png(*png, preview(image));
  const std::string json_file = json_text(json, 1) + "\n";
  if (text) text->write(std::as_bytes(std::span(json_file)));
  outputs.commit();
  print_table(json);
  for (const AtomicFile& file : outputs.files()) fmt::print("wrote {}\n", file.target().string());
  return 0;
}

}  // namespace

Command add_render(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<RenderOptions>();
  o->technique = technique_of(arguments);
  o->arguments = arguments;
  CLI::App* sub = app.add_subcommand("render", "Render one frame of a glTF scene");
  sub->add_option("SCENE", o->scene, "a .gltf or .glb file")->required();
  sub->add_option("-o,--output", o->output, "write the frame as OpenEXR")->type_name("FILE");
  o->options().add_to(*sub, "Output");
  o->frame.options().add_to(*sub, "Frame");
  sub->get_option("--fov")->needs(sub->get_option("--eye"));
  o->technique->options().add_to(*sub, "Technique " + o->technique->info().name);
  return [o] { return render(*o); };
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "view/painter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "gpu/glsl_front_end.h"
#include "scene/gltf.h"
#include "shadow/ray_traced/receivers.h"
#include "view/opening.h"
#include "view/screenshot.h"
#include "view/take_snapshot.h"

namespace izb {
namespace {

/// Thrown where a long frame is given up because something newer is asked for.
struct Interrupted {};

/// Small enough that a software renderer finishes one within a tenth of a second: between them a frame can be given up.
constexpr uint32_t slow_part_triangles = 8192;

constexpr double motion_scales[] = {1.0, 0.75, 0.5, 1.0 / 3.0, 0.25, 1.0 / 6.0, 0.125};
constexpr double longest_motion_ms = 150.0;

/// A layer that the grid has; the state may still name one of more cascades.
int layer_for(const Look& look, const Snapshot& snapshot, int layer) {
  return look.of_grid && snapshot.built ? std::clamp(layer, 0, snapshot.built->layers - 1) : 0;
}

Size scaled(Size full, double scale) {
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  return {side(full.width_px), side(full.height_px)};
}

/// What the rays of a frame depend on.
std::string truth_key(const Request& r) {
  FrameOptions frame = r.state.frame;
  const nlohmann::json& options = r.state.sides[static_cast<size_t>(r.state.active)].options;
  return fmt::format("{} {} {}x{} {} {} {}", r.state.scene, frame.options().to_json().dump(), r.size.width_px,
                     r.size.height_px, options.value("spp", ""), options.value("samples", ""),
                     options.value("nl-cull", true));
}

}  // namespace

Painter::Painter(Setup setup)
    : setup_(std::move(setup)), truth_([this](TracedTruth traced) {
        const std::scoped_lock lock(mutex_);
        traced_ = std::move(traced);
        work_.notify_one();
      }) {
  std::string failure;
  bool ready = false;
  thread_ = std::thread([&, this] {
    try {
      auto gl = std::make_unique<Gl>(setup_.context);
      const std::scoped_lock lock(mutex_);
      gl_facts_ = gl->capabilities;
      gl_ = std::move(gl);
    } catch (const Error& e) {
      failure = e.what();
    }
    {
      const std::scoped_lock lock(mutex_);
      ready = true;
      work_.notify_all();
    }
    if (gl_) run();
  });
  std::unique_lock lock(mutex_);
  work_.wait(lock, [&] { return ready; });
  lock.unlock();
  if (failure.empty()) return;
  thread_.join();
  throw Error(failure);
}

Painter::~Painter() {
  {
    const std::scoped_lock lock(mutex_);
    quit_ = true;
    work_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

// ---- from the interface ------------------------------------------------------------------------------------------

void Painter::request(Request request) {
  const std::scoped_lock lock(mutex_);
  latest_ = std::move(request);
  work_.notify_one();
}

#define IZB_JOB(call)                        \
  const std::scoped_lock lock(mutex_);       \
  jobs_.emplace_back([=, this] { (call); }); \
  work_.notify_one()

void Painter::load(const std::string& file, const FrameOptions& asked) {
  IZB_JOB(do_load(file, asked));
}
void Painter::reload_shaders() {
  IZB_JOB(do_reload());
}
void Painter::screenshot(const std::string& stem) {
  IZB_JOB(do_screenshot(stem));
}
void Painter::probe(const glm::ivec2& px) {
  IZB_JOB(probe_px_ = px);
}

template <typename T>
T taken(std::mutex& mutex, T& value) {
  const std::scoped_lock lock(mutex);
  return std::exchange(value, {});
}

std::shared_ptr<const Frame> Painter::take_frame() {
  return taken(mutex_, frame_);
}
std::shared_ptr<const SceneFacts> Painter::take_scene() {
  return taken(mutex_, facts_);
}
std::optional<ProbedPixel> Painter::take_probe() {
  return taken(mutex_, probed_);
}
std::optional<ShaderFlag> Painter::take_shaders() {
  return taken(mutex_, shaders_);
}
std::vector<Message> Painter::take_messages() {
  return taken(mutex_, messages_);
}
std::vector<std::vector<std::string>> Painter::take_written() {
  return taken(mutex_, written_);
}

// ---- the painter's own thread ------------------------------------------------------------------------------------

void Painter::run() {
  while (true) {
    wait_for_work();
    if (quit_) break;
    Job job;
    bool traced = false;
    {
      const std::scoped_lock lock(mutex_);
      if (!jobs_.empty()) {
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      traced = traced_.has_value();
    }
    busy_ = true;
    try {
      if (job)
        job();
      else if (traced)
        show_truth();
      else
        paint_latest();
      if (probe_px_ && last_ && settled()) probe_now();
    } catch (const Interrupted&) {
      // What a draw had enabled. The next frame makes the rest anew.
      glDisable(GL_DEPTH_CLAMP);
      glDisable(GL_DEPTH_TEST);
      glDepthMask(GL_TRUE);
    } catch (const Error& e) {
      say(true, e.what());
    } catch (const std::bad_alloc&) {
      say(true, "not enough memory");
    } catch (const std::exception& e) {  // a bug: the program goes on, and says so
      say(true, fmt::format("unexpected failure: {}", e.what()));
      refined_ = painted_;
    }
    check_gl();
    busy_ = false;
    setup_.wake();
  }
  // GL objects go before their context.
  truth_.cancel();
  for (Side& side : sides_) side.forget();
  truth_side_.forget();
  open_.reset();
  gl_.reset();
}

void Painter::wait_for_work() {
  std::unique_lock lock(mutex_);
  work_.wait(lock, [&] {
    if (quit_ || !jobs_.empty() || traced_) return true;
    return latest_ && open_ && (latest_->serial != painted_ || (!latest_->motion && refined_ != painted_));
  });
}

/// Whether the last request is painted as well as it will be.
bool Painter::settled() const {
  const std::scoped_lock lock(mutex_);
  return latest_ && latest_->serial == painted_ && refined_ == painted_;
}

bool Painter::interrupted() const {
  if (painting_ == 0) return false;
  const std::scoped_lock lock(mutex_);
  return quit_ || !jobs_.empty() || (latest_ && latest_->serial != painting_);
}

void Painter::say(bool error, std::string text) {
  const std::scoped_lock lock(mutex_);
  messages_.push_back({error, std::move(text)});
}

void Painter::check_gl() {
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
    say(true, fmt::format("GL error {:#06x}: the picture may be wrong", error));
}

void Painter::publish(std::shared_ptr<Frame> frame) {
  {
    const std::scoped_lock lock(mutex_);
    frame_ = std::move(frame);
  }
  setup_.wake();
}

// ---- scenes ------------------------------------------------------------------------------------------------------

std::unique_ptr<Painter::Open> Painter::open(const std::string& file) {
  double told = 0.0;
  loading_ = 0.0f;
  auto opened = std::make_unique<Open>(load_gltf(file, false, [&](double share) {
    loading_ = static_cast<float>(share);
    if (share < told + 0.01) return;
    told = share;
    setup_.wake();
  }));
  opened->buffers = std::make_shared<SceneBuffers>(
      opened->scene, make_draw_list(opened->scene, slow() ? slow_part_triangles : largest_part_triangles),
      gl_->capabilities);
  if (slow())
    opened->buffers->between_draws = [this] {
      if (interrupted()) throw Interrupted();
    };
  return opened;
}

void Painter::do_load(const std::string& file, const FrameOptions& asked) {
  try {
    std::unique_ptr<Open> opened = open(file);
    auto facts = std::make_shared<SceneFacts>(facts_of(file, opened->scene, opened->poser, asked));
    truth_.cancel();
    tracing_ = false;
    traced_serial_ = 0;
    for (Side& side : sides_) side.forget();
    truth_side_.forget();
    truth_key_.clear();
    probe_px_.reset();
    pose_.reset();
    frozen_.reset();
    last_.reset();
    open_ = std::move(opened);
    const std::scoped_lock lock(mutex_);
    latest_.reset();  // of the scene before
    painted_ = refined_ = 0;
    facts_ = std::move(facts);
  } catch (...) {
    loading_ = -1.0f;
    throw;
  }
  loading_ = -1.0f;
}

FrameChoice Painter::choose(const ViewState& state, Size size) {
  FrameOptions options = state.frame;
  options.size = fmt::format("{}x{}", size.width_px, size.height_px);
  const std::string pose = fmt::format("{} {} {}", options.animation, options.time_s, options.loop);
  if (pose_ != pose) {
    pose_scene(open_->poser, open_->scene, options);
    pose_ = pose;
  }
  return choose_frame(options, open_->scene);
}

// ---- frames ------------------------------------------------------------------------------------------------------

void Painter::paint_latest() {
  Request request;
  {
    const std::scoped_lock lock(mutex_);
    if (!latest_) return;
    request = *latest_;
  }
  if (!open_) return;
  const bool first = request.serial != painted_;
  painted_ = request.serial;
  if (slow() && first && (request.motion || motion_scale_ < 1.0)) {
    paint(request, motion_scale_, false);
    return;
  }
  // A long frame is given up when something newer is asked for, but not while things move: there each is new.
  painting_ = request.motion ? 0 : request.serial;
  try {
    paint(request, 1.0, !request.motion);
  } catch (...) {
    painting_ = 0;
    throw;
  }
  painting_ = 0;
  if (!request.motion) refined_ = request.serial;
  if (!request.motion && wants_truth(request)) start_truth(request);
}

void Painter::paint(const Request& request, double scale, bool at_rest) {
  auto frame = std::make_shared<Frame>();
  frame->serial = request.serial;
  frame->scale = scale;
  frame->motion = !at_rest;
  frame->full = request.size;
  frame->state = request.state;
  const size_t active = static_cast<size_t>(request.state.active), other = 1 - active;
  int light = 0;
  try {
    const FrameChoice choice = choose(request.state, scaled(request.size, scale));
    frame->camera = choice.camera;
    frame->lights = choice.lights;
    light = std::clamp(request.state.active_light, 0, static_cast<int>(choice.lights.size()) - 1);
    if (request.state.compare != Compare::off && !request.state.truth)
      frame->sides[other] = sides_[other].paint(stage(), request.state.sides[other], choice, light, at_rest);
    frame->sides[active] = sides_[active].paint(stage(), request.state.sides[active], choice, light, at_rest);
  } catch (const Error& e) {
    frame->sides[active].emplace();
    frame->sides[active]->technique = request.state.sides[active].technique;
    frame->sides[active]->error = e.what();
  }
  if (!at_rest && slow()) adapt_scale(scale, *frame);
  add_difference(*frame);
  if (at_rest) {
    add_looks(*frame, request, light);
    if (request.counts && sides_[active].ready() && frame->sides[active]->error.empty())
      frame->sides[active]->counts = sides_[active].renderer().count(static_cast<size_t>(light));
    last_ = std::make_shared<Frame>(*frame);
    last_request_ = request;
  }
  publish(std::move(frame));
}

void Painter::adapt_scale(double scale, const Frame& frame) {
  double ms = 0.0;
  for (const auto& side : frame.sides)
    if (side) ms += side->frame_ms;
  const auto* at = std::find(std::begin(motion_scales), std::end(motion_scales), scale);
  if (at == std::end(motion_scales)) return;
  if (ms > longest_motion_ms && at + 1 != std::end(motion_scales)) motion_scale_ = at[1];
  if (ms < 0.4 * longest_motion_ms && at != std::begin(motion_scales)) motion_scale_ = at[-1];
}

void Painter::add_looks(Frame& frame, const Request& request, int light) {
  const size_t active = static_cast<size_t>(request.state.active);
  if (!sides_[active].ready() || !frame.sides[active] || !frame.sides[active]->error.empty()) return;
  const Look* look = request.state.look.empty() ? nullptr : find_look(request.state.look);
  unsigned needs = Need::mask | (look ? look->needs : 0u);
  if (request.light_space || request.state.frozen) needs |= Need::built | Need::windows;
  auto snapshot = std::make_shared<Snapshot>(take_snapshot(sides_[active].renderer(), sides_[active].technique(),
                                                           frame.camera, static_cast<size_t>(light), needs));
  if (truth_key_ == truth_key(request) && static_cast<size_t>(light) < shown_truth_.masks.size())
    snapshot->truth = shown_truth_.masks[static_cast<size_t>(light)];
  if (!request.state.frozen) frozen_.reset();
  if (request.state.frozen && !frozen_) frozen_ = snapshot;
  frame.snapshot = snapshot;
  frame.light_space = frozen_ ? frozen_ : frame.snapshot;
  if (!look) return;
  const Snapshot& of = look->of_grid ? *frame.light_space : *snapshot;
  if ((look->needs & ~available(of)) == 0)
    frame.look = izb::paint(*look, of, layer_for(*look, of, request.state.layer));
}

// Lit in the active side alone: orange; in the other alone: blue; over the picture, dimmed.
void Painter::add_difference(Frame& frame) {
  const auto &a = frame.sides[static_cast<size_t>(frame.state.active)],
             &b = frame.sides[static_cast<size_t>(frame.state.other())];
  if (frame.state.compare != Compare::difference || !a || !b || !a->picture || !b->picture) return;
  if (a->mask.size() != b->mask.size()) return;
  auto image = std::make_shared<Image8>(*a->picture);
  for (size_t i = 0; i < a->mask.size(); ++i) {
    uint8_t* px = &image->pixels[4 * i];
    const int grey = (px[0] * 54 + px[1] * 183 + px[2] * 19) / 1024;
    const int difference = std::popcount(b->mask[i]) - std::popcount(a->mask[i]);
    // Already one sample must be seen.
    const int strength = difference == 0 ? 0 : 80 + 175 * std::abs(difference) / 32;
    px[0] = static_cast<uint8_t>(difference > 0 ? std::max(grey, strength) : grey);
    px[1] = static_cast<uint8_t>(difference != 0 ? std::max(grey, strength / 2) : grey);
    px[2] = static_cast<uint8_t>(difference < 0 ? std::max(grey, strength) : grey);
  }
  frame.difference = std::move(image);
}

// ---- the ray-traced truth ----------------------------------------------------------------------------------------

bool Painter::wants_truth(const Request& request) const {
  const Look* look = request.state.look.empty() ? nullptr : find_look(request.state.look);
  return request.state.truth || (look && (look->needs & Need::truth));
}

void Painter::start_truth(const Request& request) {
  Side& side = sides_[static_cast<size_t>(request.state.active)];
  if (!side.ready()) return;
  const std::string key = truth_key(request);
  if (key == truth_key_ && !shown_truth_.masks.empty()) return show_truth();
  if (key == truth_key_ && tracing_) return;
  truth_key_ = key;
  shown_truth_ = {};
  TruthTask task;
  task.serial = traced_serial_ = request.serial;
  const Renderer& renderer = side.renderer();
  task.triangles = make_triangles(renderer.inputs());
  const GBufferImage gbuffer = read_gbuffer(*renderer.inputs().gbuffer);
  for (size_t i = 0; i < renderer.light_count(); ++i) {
    task.receivers.push_back(make_receivers(gbuffer, renderer.inputs(i)));
    task.lights.push_back(make_light_point(renderer.inputs(i).light));
  }
  tracing_ = true;
  truth_.start(std::move(task));
}

// The frame that was published last, with the truth beside it.
void Painter::show_truth() {
  {
    const std::scoped_lock lock(mutex_);
    if (traced_) {
      const bool is_ours = traced_->serial == traced_serial_;  // one that was given up may just have been finished
      if (is_ours) shown_truth_ = std::move(*traced_);
      traced_.reset();
      if (!is_ours) return;
      tracing_ = false;
    }
  }
  if (!shown_truth_.error.empty()) {
    say(true, shown_truth_.error);
    shown_truth_.error.clear();
    return;
  }
  if (!last_ || !open_ || shown_truth_.masks.empty() || truth_key(last_request_) != truth_key_) return;
  auto frame = std::make_shared<Frame>(*last_);
  const int light = std::clamp(frame->state.active_light, 0, static_cast<int>(shown_truth_.masks.size()) - 1);
  const Side& active = sides_[static_cast<size_t>(frame->state.active)];
  if (frame->state.truth && active.ready())
    frame->sides[static_cast<size_t>(frame->state.other())] = truth_side_.paint_given(
        stage(), frame->snapshot->samples, shown_truth_.masks, choose(frame->state, frame->full), light);
  add_difference(*frame);
  if (frame->snapshot) {
    auto snapshot = std::make_shared<Snapshot>(*frame->snapshot);
    snapshot->truth = shown_truth_.masks[static_cast<size_t>(light)];
    const Look* look = frame->state.look.empty() ? nullptr : find_look(frame->state.look);
    if (look && !look->of_grid && (look->needs & ~available(*snapshot)) == 0)
      frame->look = izb::paint(*look, *snapshot);
    frame->snapshot = std::move(snapshot);
  }
  last_ = std::make_shared<Frame>(*frame);
  publish(std::move(frame));
}

// ---- what a person asks for once ---------------------------------------------------------------------------------

void Painter::probe_now() {
  const glm::ivec2 px = *probe_px_;
  probe_px_.reset();
  Side& side = sides_[static_cast<size_t>(last_->state.active)];
  ProbedPixel probed{};
  probed.px = px;
  const Snapshot* snapshot = last_->snapshot.get();
  if (snapshot && side.ready() && px.x >= 0 && px.y >= 0 && px.x < snapshot->width_px && px.y < snapshot->height_px) {
    const int light = std::clamp(last_->state.active_light, 0, static_cast<int>(side.renderer().light_count()) - 1);
    probed = izb::probe(*snapshot, side.renderer().inputs(static_cast<size_t>(light)).triangles_vs(), px);
  }
  const std::scoped_lock lock(mutex_);
  probed_ = std::move(probed);
}

// New programs are made beside the old ones, which go on if they cannot be.
void Painter::do_reload() {
  Request request;
  {
    const std::scoped_lock lock(mutex_);
    if (latest_) request = *latest_;
  }
  ShaderFlag flag{ShaderFlag::green, "read again"};
  if (open_ && request.serial != 0) {
    const FrameChoice choice = choose(request.state, scaled(request.size, slow() ? motion_scale_ : 1.0));
    std::array<Side, 2> fresh;
    for (size_t i = 0; i < 2 && flag.color == ShaderFlag::green; ++i) {
      if (!sides_[i].ready()) continue;
      if (request.state.truth && static_cast<int>(i) != request.state.active) continue;
      const SidePicture tried = fresh[i].paint(stage(), request.state.sides[i], choice, 0, false);
      if (!tried.error.empty()) flag = {ShaderFlag::red, tried.error};
    }
    if (flag.color == ShaderFlag::green) {
      sides_ = std::move(fresh);
      truth_side_.forget();
      painted_ = refined_ = 0;
    }
  }
  const std::scoped_lock lock(mutex_);
  shaders_ = std::move(flag);
}

void Painter::do_screenshot(const std::string& stem) {
  Request request;
  {
    const std::scoped_lock lock(mutex_);
    if (!latest_) return;
    request = *latest_;
  }
  request.motion = false;
  if (refined_ != request.serial || painted_ != request.serial) paint(request, 1.0, true);
  painted_ = refined_ = request.serial;
  Side& side = sides_[static_cast<size_t>(request.state.active)];
  if (!side.ready()) fail("there is no picture to keep");
  const FrameChoice frame = choose(request.state, request.size);
  std::vector<std::string> files =
      write_screenshot(stem, request, {open_->scene, frame, *gl_, side.renderer(), side.technique(), side.timers()});
  const std::scoped_lock lock(mutex_);
  written_.push_back(std::move(files));
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "view/painter.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/machine_memory.h"
#include "scene/gltf.h"
#include "view/difference.h"
#include "view/opening.h"
#include "view/take_snapshot.h"

namespace izb {
namespace {

/// Thrown where a long frame is given up because something newer is asked for.
struct Interrupted {};

/// Small enough that a software renderer finishes one within a tenth of a second: between them a frame can be given up.
constexpr uint32_t slow_part_triangles = 8192;

constexpr double motion_scales[] = {1.0, 0.75, 0.5, 1.0 / 3.0, 0.25, 1.0 / 6.0, 0.125};
constexpr double longest_motion_ms = 150.0;

/// Before memory that views of the past took goes back to the system.
constexpr auto idle = std::chrono::milliseconds(500);

/// A layer that the grid has; the state may still name one of more cascades.
int layer_for(const Look& look, const Snapshot& snapshot, int layer) {
  return look.of_grid && snapshot.built ? std::clamp(layer, 0, snapshot.built->layers - 1) : 0;
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

void Painter::push(Job job) {
  const std::scoped_lock lock(mutex_);
  jobs_.push_back(std::move(job));
  work_.notify_one();
}

uint64_t Painter::load(const std::string& file, const FrameOptions& asked) {
  const uint64_t number = ++loads_;
  push([=, this] { do_load(file, asked, number); });
  return number;
}

void Painter::reload_shaders() {
  push([this] { do_reload(); });
}

void Painter::screenshot(const std::string& stem) {
  push([=, this] { do_screenshot(stem); });
}

void Painter::probe(const glm::ivec2& px) {
  const std::scoped_lock lock(mutex_);
  probe_px_ = px;
  work_.notify_one();
}

bool Painter::works() const {
  const std::scoped_lock lock(mutex_);
  return busy_ || tracing_ || traced_ || loading_ >= 0.0f || !jobs_.empty() || probe_px_ || frame_ || probed_ ||
         shaders_ || !written_.empty() || (latest_ && !is_painted());
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
      if (settled()) probe_now();
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
      refined_ = painted_.load();
    }
    check_gl();
    load_ = 0;
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
  const auto has_work = [&] {
    if (quit_ || !jobs_.empty() || traced_) return true;
    if (probe_px_ && is_settled()) return true;
    return latest_ && open_ && !is_painted();
  };
  if (work_.wait_for(lock, idle, has_work)) return;
  lock.unlock();
  give_back_freed_memory();
  lock.lock();
  work_.wait(lock, has_work);
}

// Whether nothing is left to do for the last request; the mutex is held.
bool Painter::is_painted() const {
  return latest_->serial == painted_ && (latest_->motion || refined_ == painted_);
}

// Whether the last request is painted as well as it will be; the mutex is held.
bool Painter::is_settled() const {
  return latest_ && latest_->serial == painted_ && refined_ == painted_;
}

bool Painter::settled() const {
  const std::scoped_lock lock(mutex_);
  return is_settled();
}

bool Painter::interrupted() const {
  if (painting_ == 0) return false;
  const std::scoped_lock lock(mutex_);
  return quit_ || !jobs_.empty() || (latest_ && latest_->serial != painting_);
}

void Painter::say(bool error, std::string text) {
  const std::scoped_lock lock(mutex_);
  messages_.push_back({error, std::move(text), load_});
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

void Painter::do_load(const std::string& file, const FrameOptions& asked, uint64_t number) {
  load_ = number;
  try {
    std::unique_ptr<Open> opened = open(file);
    auto facts = std::make_shared<SceneFacts>(facts_of(file, opened->scene, opened->poser, asked));
    facts->load = number;
    truth_.cancel();
    tracing_ = false;
    traced_serial_ = 0;
    for (Side& side : sides_) side.forget();
    truth_side_.forget();
    truth_key_.clear();
    pose_.reset();
    frozen_.reset();
    last_.reset();
    open_ = std::move(opened);
    const std::scoped_lock lock(mutex_);
    latest_.reset();  // of the scene before
    probe_px_.reset();
    painted_ = 0, refined_ = 0;
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
    const FrameChoice choice = choose(request.state, request.size.scaled(scale));
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
    try {
      add_looks(*frame, request, light);
      if (request.counts && sides_[active].ready() && frame->sides[active]->error.empty())
        frame->sides[active]->counts = sides_[active].renderer().count(static_cast<size_t>(light));
    } catch (const Error& e) {  // the picture itself is there
      say(true, e.what());
    } catch (const std::bad_alloc&) {
      say(true, "not enough memory for this view");
    }
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

void Painter::add_difference(Frame& frame) {
  const auto &a = frame.sides[static_cast<size_t>(frame.state.active)],
             &b = frame.sides[static_cast<size_t>(frame.state.other())];
  if (frame.state.compare != Compare::difference || !a || !b || !a->picture || !b->picture) return;
  frame.difference = std::make_shared<const Image8>(difference_picture(*a->picture, a->mask, b->mask));
}

}  // namespace izb

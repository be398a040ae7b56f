// SPDX-License-Identifier: MIT
// What a person asks the painter for once: a look at a pixel, shaders read again, a screenshot.
#include <algorithm>

#include "base/error.h"
#include "view/painter.h"
#include "view/screenshot.h"

namespace izb {

void Painter::probe_now() {
  glm::ivec2 px;
  {
    const std::scoped_lock lock(mutex_);
    if (!probe_px_) return;
    px = *probe_px_;
    probe_px_.reset();
  }
  ProbedPixel probed{};
  probed.px = px;
  if (!last_) return publish_probe(std::move(probed));
  Side& side = sides_[static_cast<size_t>(last_->state.active)];
  const Snapshot* snapshot = last_->snapshot.get();
  if (snapshot && side.ready() && px.x >= 0 && px.y >= 0 && px.x < snapshot->width_px && px.y < snapshot->height_px) {
    const int light = std::clamp(last_->state.active_light, 0, static_cast<int>(side.renderer().light_count()) - 1);
    probed = izb::probe(*snapshot, side.renderer().inputs(static_cast<size_t>(light)).triangles_vs(), px);
  }
  publish_probe(std::move(probed));
}

void Painter::publish_probe(ProbedPixel probed) {
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
    const FrameChoice choice = choose(request.state, request.size.scaled(slow() ? motion_scale_ : 1.0));
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
      painted_ = 0, refined_ = 0;
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
  {
    const std::scoped_lock lock(mutex_);
    written_.push_back(std::move(files));
  }
  if (wants_truth(request)) start_truth(request);
}

}  // namespace izb

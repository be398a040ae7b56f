// SPDX-License-Identifier: MIT
// The painter's part in the ray-traced truth: when it is traced, and how it comes beside the frame that it is of.
#include <fmt/format.h>

#include <algorithm>

#include "base/json_text.h"
#include "shadow/ray_traced/receivers.h"
#include "view/painter.h"

namespace izb {

std::string Painter::truth_key(const Request& r) {
  FrameOptions frame = r.state.frame;
  const nlohmann::json& options = r.state.sides[static_cast<size_t>(r.state.active)].options;
  return fmt::format("{} {} {}x{} {} {} {}", r.state.scene, json_text(frame.options().to_json()), r.size.width_px,
                     r.size.height_px, options.value("spp", ""), options.value("samples", ""),
                     options.value("nl-cull", true));
}

bool Painter::wants_truth(const Request& request) const {
  const Look* look = request.state.look.empty() ? nullptr : find_look(request.state.look);
  return request.state.truth || (look && (look->needs & Need::truth));
}

void Painter::start_truth(const Request& request) {
  Side& side = sides_[static_cast<size_t>(request.state.active)];
  if (!side.ready() || !last_ || !last_->snapshot || last_->serial != request.serial) return;
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
  if (!last_ || !last_->snapshot || shown_truth_.masks.empty() || truth_key(last_request_) != truth_key_) return;
  if (last_request_.serial != painted_) return;  // something newer is shown; at rest it asks for the truth again
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

}  // namespace izb

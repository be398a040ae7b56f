// SPDX-License-Identifier: MIT
#include "view/window/ui.h"

#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/machine_memory.h"
#include "gpu/glsl_front_end.h"

namespace izb {
namespace {

constexpr double graph_s = 10.0, kept_timings_s = 60.0;

/// What of the state the painter must know.
std::string painted_part(const ViewState& state, Size size, bool counts, bool light_space) {
  ViewState part = state;
  part.split = 0.5;
  part.lens = false;
  part.lens_power = 8;
  part.picked.reset();
  part.frusta = false;  // counts in `light_space`
  // To look at one side first and then at both takes another request, to flicker between them none.
  if (part.compare == Compare::flicker) part.compare = Compare::split;
  return fmt::format("{} {}x{} {} {}", json_text(part.to_json()), size.width_px, size.height_px, counts, light_space);
}

}  // namespace

Ui::Ui(Window& window, Painter& painter, Report& report, UiSetup setup)
    : window_(window),
      painter_(painter),
      report_(report),
      shader_watch_(gpu::glsl_folder()),
      folder_(std::filesystem::absolute(setup.folder).lexically_normal()),
      settings_file_(std::move(setup.settings)),
      state_(std::move(setup.state)) {
  for (size_t i = 0; i < 2; ++i) options_[i] = state_.sides[i].make();
  try {
    hints_ = read_settings(settings_file_).hints;
  } catch (const Error& e) {
    say(true, e.what());
  }
  const auto pair = [](Size s) { return nlohmann::json::array({s.width_px, s.height_px}); };
  report_.write("opened", {{"window", pair(window_.size())},
                           {"framebuffer", pair(window_.framebuffer())},
                           {"renderer", window_.renderer()},
                           {"slow", painter_.slow()}});
  painter_.load(state_.scene, state_.frame);
}

void Ui::run() {
  while (!window_.closing()) {
    const bool drawn = window_.begin_frame(wait_s());
    const double before_s = now_s_;
    now_s_ = ImGui::GetTime();
    take_results();
    if (!drawn) continue;
    handle_input();
    handle_fly(now_s_ - before_s);
    advance_time(now_s_ - before_s);
    send_request();
    draw_picture();
    draw_overlays();
    draw_panels();
    draw_grid_window();
    draw_pixel_window();
    draw_lens();
    draw_flag();
    draw_toasts();
    draw_hints();
    draw_help();
    window_.end_frame();
    report_changes();
  }
  report_.write("closed");
}

/// How long nothing needs to be drawn by itself.
double Ui::wait_s() const {
  const bool moves = playing_ || flying_ || replay_start_s_ || painter_.loading() >= 0.0f || recorder_;
  if (moves) return painter_.slow() ? 1.0 / 30.0 : 0.0;
  if (click_) return 0.1;
  if (state_.compare == Compare::flicker || painter_.tracing() >= 0.0f) return 0.1;
  if (requested_motion_ || (report_.on() && !rest_reported_)) return 0.05;  // until it is at rest
  return 0.5;
}

void Ui::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& e) {
    say(true, e.what());
  }
}

void Ui::say(bool error, std::string text) {
  report_.write("message", {{"kind", error ? "error" : "info"}, {"text", text}});
  toasts_.push_back({{error, std::move(text)}, now_s_ + (error ? 20.0 : 6.0)});
  while (toasts_.size() > 6) toasts_.pop_front();
}

void Ui::keep(const std::string& what, const std::filesystem::path& file, const std::string& text) {
  attempt([&] {
    write_file_atomically(file, text);
    say(false, fmt::format("{}: {}", what, file.string()));
    report_.write("wrote", {{"files", {file.string()}}});
  });
}

void Ui::take_results() {
  for (const std::string& file : window_.take_dropped()) drop(file);
  for (const Message& message : painter_.take_messages()) {
    if (message.error && loading_state_ && loading_state_->load == message.load) loading_state_.reset();
    say(message.error, message.text);
  }
  if (const auto facts = painter_.take_scene()) open(*facts);
  if (const auto frame = painter_.take_frame()) take_frame(frame);
  if (auto probed = painter_.take_probe()) {
    nlohmann::json occluders = nlohmann::json::array(), texels = nlohmann::json::array();
    for (const Occluder& o : probed->occluders) occluders.push_back({{"triangle", o.triangle}, {"bits", o.bits}});
    for (const auto& [layer, texel] : probed->texels) texels.push_back({layer, texel.x, texel.y});
    report_.write(
        "picked",
        {{"px", {probed->px.x, probed->px.y}}, {"mask", probed->mask}, {"occluders", occluders}, {"texels", texels}});
    if (asked_probe_ == probed->px) asked_probe_.reset();
    if (state_.picked == probed->px) lit_texels_ = probed->texels;
    probed_ = std::move(probed);
  }
  for (const auto& files : painter_.take_written()) {
    say(false, "screenshot: " + files.front());
    report_.write("wrote", {{"files", files}});
  }
  if (auto flag = painter_.take_shaders()) {
    flag_ = std::move(*flag);
    constexpr const char* colors[] = {"white", "green", "red"};
    report_.write("shaders", {{"flag", colors[flag_.color]}, {"text", flag_.text}});
  }
  if (now_s_ - last_watch_s_ > 0.5) {
    last_watch_s_ = now_s_;
    if (shader_watch_.changed()) painter_.reload_shaders();
  }
}

void Ui::open(const SceneFacts& facts) {
  facts_ = std::make_shared<SceneFacts>(facts);
  if (loading_state_ && loading_state_->load == facts.load) {
    state_ = loading_state_->state;
    loading_state_.reset();
    for (size_t i = 0; i < 2; ++i) options_[i] = state_.sides[i].make();
  }
  state_.scene = facts.file;
  state_.frame = facts.frame;
  pose_known_ = !state_.frame.eye.empty();
  if (pose_known_) pose_ = CameraPose::of(state_.frame);
  lit_points_ws_.clear();
  lit_texels_.clear();
  probed_.reset();
  asked_probe_.reset();
  click_.reset();
  moved_light_.reset();
  frame_.reset();
  for (PictureTexture& picture : side_pictures_) picture.show(nullptr, false);
  playing_ = false;
  replay_start_s_.reset();
  requested_.clear();  // also where the same is shown again
  requested_motion_ = false;
  first_serial_ = serial_ + 1;
  if (state_.picked) pick(*state_.picked);
  report_.write("scene", {{"file", facts.file}, {"triangles", facts.triangles}});
  for (const std::string& sentence : facts.ignored) say(false, sentence);
}

void Ui::take_frame(const std::shared_ptr<const Frame>& frame) {
  if (!facts_ || frame->serial < first_serial_) return;
  const bool again = frame_ && frame_->serial == frame->serial && frame_->scale == frame->scale;  // with the truth
  frame_ = frame;
  const bool smooth = frame->scale < 1.0;
  nlohmann::json sides = nlohmann::json::array();
  double frame_ms = 0.0;
  for (int i = 0; i < 2; ++i) {
    const auto& side = frame->sides[static_cast<size_t>(i)];
    side_pictures_[static_cast<size_t>(i)].show(side ? side->picture : nullptr, smooth);
    if (!side) continue;
    frame_ms += side->frame_ms;
    nlohmann::json entry{
        {"name", i == 0 ? "A" : "B"}, {"technique", side->technique}, {"spp", side->spp}, {"error", side->error}};
    if (!side->mask_hash.empty()) entry["mask_hash"] = side->mask_hash;
    sides.push_back(std::move(entry));
    if (!again && !side->stages.empty())
      timings_.push_back({now_s_, frame->scale, i, fmt::format("{} {} spp", side->technique, side->spp), side->stages});
  }
  while (!timings_.empty() && timings_.front().at_s < now_s_ - kept_timings_s) timings_.pop_front();
  difference_.show(frame->difference, smooth);
  look_.show(frame->look ? std::make_shared<const Image8>(frame->look->picture) : nullptr, false);
  follow_camera(*frame);
  if (!frame->motion && frame->serial != probed_serial_) {
    probed_serial_ = frame->serial;  // what was looked at was of another picture
    probed_.reset();
    lit_texels_.clear();
    if (state_.picked) ask_probe(*state_.picked);
  }
  const glm::dvec3 eye(frame->camera.world_from_view[3]);
  taken_.push_back({{"serial", frame->serial},
                    {"scale", frame->scale},
                    {"motion", frame->motion},
                    {"frame_ms", frame_ms},
                    {"eye", {eye.x, eye.y, eye.z}},
                    {"sides", sides}});
}

/// A camera of the scene or of a path is where the frame had it, whatever moves it.
void Ui::follow_camera(const Frame& frame) {
  const FrameOptions &its = frame.state.frame, &mine = state_.frame;
  if (!mine.eye.empty() || frame.lights.empty()) return;  // moved by hand; or there was no such camera
  if (its.eye != mine.eye || its.camera != mine.camera || its.camera_path != mine.camera_path) return;
  const double distance = glm::distance(glm::dvec3(frame.camera.world_from_view[3]), facts_->center_ws);
  pose_ = CameraPose::of(frame.camera, std::max(distance, 1e-3 * facts_->radius_ws));
  pose_known_ = true;
}

void Ui::ask_probe(const glm::ivec2& px) {
  asked_probe_ = px;
  painter_.probe(px);
}

void Ui::send_request() {
  if (!facts_) return;
  const Size size = window_.framebuffer();
  const bool light_space = state_.frusta || state_.picked || !lit_points_ws_.empty() || state_.frozen;
  const std::string part = painted_part(state_, size, counts_, light_space);
  const bool changed = part != requested_;
  const bool held = dragging_view_ || flying_ || playing_ || replay_start_s_.has_value();
  if (changed && held) last_motion_s_ = now_s_;
  const bool motion = held && (changed || now_s_ - last_motion_s_ < 0.3);
  if (!changed && motion == requested_motion_) return;
  if (!changed && motion) return;
  requested_ = part;
  requested_motion_ = motion;
  rest_reported_ = false;
  painter_.request({++serial_, state_, size, motion, counts_ && !motion, light_space});
}

void Ui::report_changes() {
  const std::vector<Window::Answer> answers = window_.take_answers();
  for (const nlohmann::json& picture : std::exchange(taken_, {})) report_.write("picture", picture);
  if (!report_.on()) return;
  for (const Window::Answer& answer : answers) {
    report_.write("answer", {{"input", answer.input}, {"ms", answer.ms}});
    rest_reported_ = false;
  }
  if (now_s_ - last_memory_s_ > 5.0) {
    last_memory_s_ = now_s_;
    if (const auto bytes = process_memory()) report_.write("memory", {{"bytes", *bytes}});
  }
  if (now_s_ - last_report_s_ < 0.1) return;
  last_report_s_ = now_s_;
  if (const std::string now = json_text(state_.to_json()); facts_ && now != reported_state_) {
    reported_state_ = now;
    report_.write("state", {{"state", state_.to_json()}});
  }
  if (rects_ != reported_rects_) {
    reported_rects_ = rects_;
    report_.write("widgets", {{"rects", rects_}});
  }
  if (rest_reported_ || !rests()) return;
  rest_reported_ = true;
  report_.write("rest", {{"serial", serial_}});
}

/// Whether the window shows all that was asked for.
bool Ui::rests() const {
  if (!facts_ || loading_state_ || painter_.works()) return false;
  return frame_ && frame_->serial == serial_ && !frame_->motion && !requested_motion_ && !asked_probe_ && !click_;
}

}  // namespace izb

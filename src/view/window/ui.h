// SPDX-License-Identifier: MIT
// The interface: turns what a person does into a ViewState, asks the painter for it, and shows what comes back.
#pragma once
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/camera_control.h"
#include "view/painter.h"
#include "view/path_recorder.h"
#include "view/report.h"
#include "view/settings.h"
#include "view/shader_watch.h"
#include "view/window/picture_texture.h"
#include "view/window/window.h"

struct ImVec2;
struct ImDrawList;

namespace izb {

struct UiSetup {
  ViewState state;  ///< scene and sides; its frame is what the command line asked for
  std::filesystem::path folder, settings;
};

class Ui {
 public:
  Ui(Window& window, Painter& painter, Report& report, UiSetup setup);
  /// Until the window is closed.
  void run();

 private:
  struct Toast {
    Message message;
    double until_s;
  };
  /// One frame's times, for the graph and the CSV.
  struct Timing {
    double at_s, scale;
    int side;
    std::string technique;
    std::vector<StageTime> stages;
  };

  // ui.cpp: what comes and goes
  double wait_s() const;
  void take_results();
  void take_frame(const std::shared_ptr<const Frame>& frame);
  void open(const SceneFacts& facts);
  void follow_camera(const Frame& frame);
  void ask_probe(const glm::ivec2& px);
  void send_request();
  void report_changes();
  bool rests() const;
  void say(bool error, std::string text);
  void keep(const std::string& what, const std::filesystem::path& file, const std::string& text);
  void attempt(const std::function<void()>& action);

  // input.cpp
  void handle_input();
  void handle_keys();
  void handle_mouse();
  void handle_fly(double dt_s);
  void turn_light(float dx, float dy, float wheel);
  void pick_later(const ImVec2& at);
  void pick(const glm::ivec2& px);
  void focus_on(const ImVec2& at);

  // actions.cpp: what a key and a button both do
  void leave_path();
  void move_camera();
  void show_camera(const std::string& label);
  void next_camera();
  void set_side(const SideState& side);
  void next_preset();
  void next_technique();
  void toggle_samples();
  void next_compare();
  void toggle_truth();
  void step_look(int step);
  void advance_time(double dt_s);
  void step_time(double seconds);
  void take_screenshot();
  void toggle_recording();
  void replay();
  void copy_command();
  void save_state();
  void load_state();
  void drop(const std::string& file);
  void export_times();
  std::string command() const;

  // panels.cpp
  void draw_panels();
  void scene_panel();
  void camera_panel();
  void light_panel();
  void technique_panel();
  void option_widget(const Option& option);
  void compare_panel();
  void stages_panel();
  void keep_panel();
  void mark(const char* label);

  // measure.cpp
  void measure_panel();
  void draw_graph();

  // picture.cpp: what lies on the picture
  void draw_picture();
  void draw_side(int side, float x0, float x1);
  void draw_split_bar();
  void draw_overlays();
  void draw_light();
  void draw_frusta();
  void draw_lit_points();
  void draw_status();
  void draw_line_ws(const glm::dvec3& a, const glm::dvec3& b, unsigned color, float width);
  std::optional<ImVec2> project(const glm::dvec3& p_ws) const;

  // lens.cpp
  void draw_lens();
  void draw_samples(const SidePicture& side, const ImVec2& corner, float side_px, const glm::ivec2& px);
  void draw_pixel_window();

  // grid.cpp
  void draw_grid_window();
  void pick_texel(const glm::ivec2& texel);

  // help.cpp
  void draw_help();
  void draw_hints();
  void draw_toasts();
  void draw_flag();

  int shown_side() const { return state_.active; }
  bool over_interface() const;

  Window& window_;
  Painter& painter_;
  Report& report_;
  ShaderWatch shader_watch_;
  std::filesystem::path folder_, settings_file_;

  ViewState state_;
  CameraPose pose_;
  bool pose_known_ = false;                            ///< pose_ is the camera that the options name
  std::array<std::unique_ptr<Technique>, 2> options_;  ///< hold the values that the widgets change
  std::shared_ptr<const SceneFacts> facts_;
  std::shared_ptr<const Frame> frame_;
  std::array<PictureTexture, 2> side_pictures_;
  PictureTexture difference_, look_;
  std::optional<ProbedPixel> probed_;
  std::optional<glm::ivec2> asked_probe_;               ///< and not answered
  std::optional<std::pair<double, glm::ivec2>> click_;  ///< when and where: a pick, unless another follows
  std::vector<glm::dvec3> lit_points_ws_;               ///< of the texel that was picked
  std::vector<std::pair<int, glm::ivec2>> lit_texels_;  ///< of the pixel that was picked
  struct LoadingState {
    uint64_t load;
    ViewState state;
  };
  std::optional<LoadingState> loading_state_;            ///< until its scene is there
  std::optional<std::pair<size_t, Light>> moved_light_;  ///< as it was dragged last

  uint64_t serial_ = 0;
  uint64_t first_serial_ = 1;   ///< of the scene that is open
  uint64_t probed_serial_ = 0;  ///< of the picture that probed_ is of
  std::string requested_;       ///< what the last request shows
  bool requested_motion_ = false;
  std::vector<nlohmann::json> taken_;  ///< pictures whose lines wait until the window has shown them
  std::string reported_state_;
  bool rest_reported_ = false;
  std::map<std::string, std::array<float, 4>> rects_, reported_rects_;
  std::pair<std::weak_ptr<const Snapshot>, int> grid_shown_;  ///< of which grid_square_ is; an address may come again
  glm::ivec3 grid_square_{0};                                 ///< of the grid: lower left texel, side
  double now_s_ = 0.0, last_report_s_ = -1.0, last_watch_s_ = 0.0, last_memory_s_ = 0.0, last_motion_s_ = -10.0;

  bool panels_ = true, help_ = false, hints_ = false, counts_ = false, show_light_ = false;
  bool dragging_bar_ = false, dragging_view_ = false, playing_ = false, flying_ = false, flicker_on_ = false;
  double fly_speed_ = 1.0;  ///< scene radii in four seconds
  std::optional<PathRecorder> recorder_;
  std::string last_path_;
  std::optional<double> replay_start_s_;
  double replay_length_s_ = 0.0;
  ShaderFlag flag_;
  std::deque<Toast> toasts_;
  std::deque<Timing> timings_;
  char state_file_[256] = "izb-state.json";
};

}  // namespace izb

// SPDX-License-Identifier: MIT
// The picture's thread: owns a GL context, the scene and the sides, and paints the latest request. The interface never
// waits for it.
//
// Its context is of its own, not shared with the window's: llvmpipe rasterises all contexts of one screen one after the
// other, so that a window that shares objects with a long frame would wait for it. Pictures go over as pixels.
#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/session.h"
#include "view/frame.h"
#include "view/side.h"
#include "view/truth_job.h"

namespace izb {

class Painter {
 public:
  struct Setup {
    std::string context = "auto";
    std::function<void()> wake;  ///< called from the painter's thread when there is something new
  };

  /// Makes the context and returns when it is there. Throws izb::Error if none can be made.
  explicit Painter(Setup setup);
  ~Painter();

  // From the interface; none waits for the painter.
  /// `asked`: the frame as a command line would ask for it. Returns the load's number, which its outcome will name.
  uint64_t load(const std::string& file, const FrameOptions& asked);
  void request(Request request);
  void reload_shaders();
  /// Writes the picture at full resolution of the active side of the last request.
  void screenshot(const std::string& stem);
  void probe(const glm::ivec2& px);

  // What has happened since the last call, oldest first.
  std::shared_ptr<const Frame> take_frame();
  std::shared_ptr<const SceneFacts> take_scene();
  std::optional<ProbedPixel> take_probe();
  std::optional<ShaderFlag> take_shaders();
  std::vector<Message> take_messages();
  std::vector<std::vector<std::string>> take_written();

  const gpu::Capabilities& capabilities() const { return gl_facts_; }
  bool slow() const { return gl_facts_.software; }
  float loading() const { return loading_; }  ///< share, or negative: nothing is loaded
  float tracing() const { return tracing_ ? truth_.progress() : -1.0f; }
  bool busy() const { return busy_; }
  /// Whether something is asked for that has not been taken yet, or is being made.
  bool works() const;

 private:
  /// A scene that is open.
  struct Open {
    Scene scene;
    Poser poser;
    std::shared_ptr<SceneBuffers> buffers;
    explicit Open(Scene its) : scene(std::move(its)), poser(scene) {}
  };
  using Job = std::function<void()>;

  void push(Job job);
  void run();
  void wait_for_work();
  bool is_painted() const;
  bool settled() const;
  bool is_settled() const;
  bool interrupted() const;
  void do_load(const std::string& file, const FrameOptions& asked, uint64_t number);
  std::unique_ptr<Open> open(const std::string& file);
  void do_reload();
  void do_screenshot(const std::string& stem);
  void probe_now();
  void publish_probe(ProbedPixel probed);
  void paint_latest();
  void paint(const Request& request, double scale, bool at_rest);
  FrameChoice choose(const ViewState& state, Size size);
  void add_looks(Frame& frame, const Request& request, int light);
  void add_difference(Frame& frame);
  /// What the rays of a frame depend on.
  static std::string truth_key(const Request& request);
  bool wants_truth(const Request& request) const;
  void start_truth(const Request& request);
  void show_truth();
  void adapt_scale(double scale, const Frame& frame);
  void publish(std::shared_ptr<Frame> frame);
  void say(bool error, std::string text);
  void check_gl();
  Stage3D stage() { return {open_->scene, *gl_, open_->buffers}; }

  Setup setup_;
  gpu::Capabilities gl_facts_;
  std::unique_ptr<Gl> gl_;
  std::unique_ptr<Open> open_;
  std::array<Side, 2> sides_;
  Side truth_side_;
  double motion_scale_ = 0.25;
  uint64_t load_ = 0;            ///< the load at work; 0: none
  std::shared_ptr<Frame> last_;  ///< published last, at rest
  Request last_request_;         ///< of it
  std::shared_ptr<const Snapshot> frozen_;
  std::optional<std::string> pose_;     ///< as the scene stands
  std::atomic<uint64_t> painting_ = 0;  ///< serial; 0: what is painted is not given up
  std::atomic<uint64_t> painted_ = 0, refined_ = 0;

  TruthJob truth_;
  std::atomic<bool> tracing_ = false;
  std::optional<TracedTruth> traced_;  ///< guarded
  TracedTruth shown_truth_;
  std::string truth_key_;       ///< of what is or was traced
  uint64_t traced_serial_ = 0;  ///< likewise

  uint64_t loads_ = 0;  ///< the interface's

  mutable std::mutex mutex_;
  std::condition_variable work_;
  std::deque<Job> jobs_;
  std::optional<glm::ivec2> probe_px_;  ///< no job: no long frame is given up for it
  std::optional<Request> latest_;
  std::atomic<bool> quit_ = false, busy_ = false;
  std::atomic<float> loading_ = -1.0f;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const SceneFacts> facts_;
  std::optional<ProbedPixel> probed_;
  std::optional<ShaderFlag> shaders_;
  std::vector<Message> messages_;
  std::vector<std::vector<std::string>> written_;
  std::thread thread_;
};

}  // namespace izb

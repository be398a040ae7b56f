// SPDX-License-Identifier: MIT
// What flickers: how the share of light in each pixel changes while camera or light move by a fraction of a pixel.
#include <fmt/format.h>

#include <cmath>

#include "app/bench/lit_share.h"
#include "app/bench/measure_parts.h"
#include "base/error.h"
#include "base/progress.h"
#include "frame/samples.h"
#include "image/heat_map.h"
#include "image/png.h"

namespace izb::bench {
namespace {

/// What one configuration did over the frames. Sums are over pixels and steps.
struct Changes {
  std::vector<float> before, flips_a_pixel;
  double change = 0.0, excess = 0.0;
  uint64_t flips = 0;
};

/// The frame as the configuration sees it: by `supersample` (a note of it) shifted ones, or by one.
std::vector<float> light_seen(Subject& s) {
  const int frames = s.configuration.notes.value("supersample", 1);
  if (frames == 1) {
    s.renderer->render(s.frame.camera, s.frame.lights, s.timers);
    return lit_share(*s.renderer);
  }
  std::vector<float> sum;
  for (int n = 0; n < frames; ++n) {
    Camera camera = s.frame.camera;
    camera.pixel_shift += pixel_shift(static_cast<uint32_t>(n));
    s.renderer->render(camera, s.frame.lights, s.timers);
    const std::vector<float> lit = lit_share(*s.renderer);
    sum.resize(lit.size());
    for (size_t i = 0; i < lit.size(); ++i) sum[i] += lit[i] / float(frames);
  }
  return sum;
}

/// `truth`: how far each pixel truly changed in this step.
void add_step(Changes& c, const std::vector<float>& now, const std::vector<float>& truth) {
  if (c.before.empty()) c.flips_a_pixel.resize(now.size());
  for (size_t i = 0; i < c.before.size(); ++i) {
    const float step = now[i] - c.before[i];
    c.change += std::abs(step);
    if (!truth.empty()) c.excess += std::abs(step - truth[i]);
    const bool flipped = (now[i] >= 0.5f) != (c.before[i] >= 0.5f);
    c.flips += flipped;
    c.flips_a_pixel[i] += flipped;
  }
  c.before = now;
}

/// `v` by an angle about an axis across it, as near to the vertical as there is.
glm::dvec3 turned(const glm::dvec3& v, double angle_rad) {
  const double length = glm::length(v);
  if (!(length > 0.0)) return v;
  const glm::dvec3 along = v / length;
  const glm::dvec3 up = std::abs(along.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 axis = glm::normalize(up - along * glm::dot(up, along));
  return std::cos(angle_rad) * v + std::sin(angle_rad) * glm::cross(axis, v);
}

/// The scene's camera with its grid of pixels moved, or its light turned, by `step` steps. A light that shines all
/// around goes around the scene's middle.
void stand(const Job& job, const FrameChoice& at_rest, const glm::dvec3& middle_ws, int step, Camera& camera,
           std::vector<Light>& lights) {
  camera = at_rest.camera, lights = at_rest.lights;
  if (job.part == "camera") {
    // A direction along which no row or column of pixels is met twice.
    camera.pixel_shift += step * job.settings.at("step_px").get<double>() * glm::dvec2(0.8, 0.6);
    return;
  }
  const double angle_rad = glm::radians(step * job.settings.at("step_deg").get<double>());
  for (Light& light : lights)
    if (light.type == LightType::point)
      light.position_ws = middle_ws + turned(light.position_ws - middle_ws, angle_rad);
    else
      light.direction_ws = turned(light.direction_ws, angle_rad);
}

/// How far each pixel changed since the last step; nothing before the first.
std::vector<float> step_of(const Changes& c, const std::vector<float>& lit) {
  std::vector<float> step;
  for (size_t i = 0; i < c.before.size(); ++i) step.push_back(lit[i] - c.before[i]);
  return step;
}

nlohmann::json temporal_json(const Changes& c, int steps, bool truth_works) {
  const double pixel_steps = double(c.before.size()) * steps;
  nlohmann::json its{{"flips", c.flips},
                     {"flips_a_thousand_pixel_steps", 1e3 * double(c.flips) / pixel_steps},
                     {"mean_change", c.change / pixel_steps}};
  if (truth_works)
    its["mean_difference_from_truth"] = c.excess / pixel_steps;
  else
    its["mean_difference_from_truth_failed"] = "the truth could not be had";
  return its;
}

}  // namespace

void measure_temporal(const Job& job, Subjects& subjects, const std::filesystem::path& folder, nlohmann::json& result) {
  if (job.frames < 2) fail("flicker needs two frames, not {}", job.frames);
  const FrameChoice at_rest = subjects.all().front().frame;
  const glm::dvec3 middle_ws = world_bounds(subjects.session().scene).center();
  std::vector<Changes> changes(subjects.all().size());
  for (Subject& s : subjects.all())
    if (s.works()) s.renderer->keep_geometry(true);
  // The truth is the sweep's first configuration.
  const Subject& truth = subjects.all().front();
  Progress progress(job.experiment + " " + job.scene.name, uint64_t(job.frames));
  for (int step = 0; step < job.frames; ++step) {
    Camera camera;
    std::vector<Light> lights;
    stand(job, at_rest, middle_ws, step, camera, lights);
    subjects.look(camera, lights);
    std::vector<float> truth_step;
    size_t i = 0;
    for (Subject& s : subjects.all()) {
      Changes& c = changes[i++];
      if (!s.works()) continue;
      try {
        const std::vector<float> lit = light_seen(s);
        if (&s == &truth) truth_step = step_of(c, lit);
        add_step(c, lit, truth_step);
      } catch (const Error& e) {
        s.failed = e.what();
      }
      s.timers.clear();
    }
    progress.advance();
  }
  result["configurations"] = subjects.results(false);
  std::vector<nlohmann::json> files;
  size_t i = 0;
  for (Subject& s : subjects.all()) {
    const Changes& c = changes[i];
    nlohmann::json& its = result["configurations"][i++];
    if (!s.works()) continue;
    its["temporal"] = temporal_json(c, job.frames - 1, truth.works());
    const std::string name = fmt::format("images/temporal-{}-{}-{}.png", job.part, file_word(job.scene.name), i);
    write_png(folder / name, heat_map(c.flips_a_pixel, s.frame.size.width_px, s.frame.size.height_px, 6.0f));
    files.push_back({{"file", name}, {"label", s.configuration.name}});
  }
  if (files.empty()) return;
  result["pictures"] = {{"title", fmt::format("Flips a pixel, {} moving: {}", job.part, job.scene.name)},
                        {"caption", "From none (dark) to six and more (bright)."},
                        {"files", files},
                        {"pixelated", true}};
}

}  // namespace izb::bench

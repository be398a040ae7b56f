// SPDX-License-Identifier: MIT
#include "app/bench/subjects.h"

#include "app/results.h"
#include "app/statistics.h"
#include "base/error.h"

namespace izb::bench {
namespace {

/// A technique that costs next to nothing, so that the session itself refuses none of the configurations.
std::unique_ptr<Technique> smallest_technique() {
  Configuration smallest;
  smallest.technique = "shadow_map";
  smallest.options = {{"resolution", "64"}, {"filter", "none"}};
  return make_technique(smallest);
}

FrameOptions smallest_frame(const Job& job) {
  FrameOptions options = frame_options(job);
  options.size = "16x16";
  return options;
}

/// What a configuration is, whether it works or not.
nlohmann::json description(Subject& s) {
  nlohmann::json result{{"name", s.configuration.name},
                        {"technique", s.configuration.technique},
                        {"preset", s.configuration.preset},
                        {"command_line", s.configuration.command_line()},
                        {"size", fmt::format("{}x{}", s.frame.size.width_px, s.frame.size.height_px)},
                        {"notes", s.configuration.notes}};
  if (s.technique) result["options"] = s.technique->options().to_json();
  return result;
}

}  // namespace

Subjects::Subjects(const Job& job) : session_(smallest_frame(job), smallest_technique(), job.scene.file) {
  for (const Configuration& configuration : job.configurations) {
    Subject& s = subjects_.emplace_back(configuration, session_.frame, session_.timers.wall_clock());
    s.frame.size = parse_size(configuration.size.empty() ? job.size : configuration.size);
    try {
      s.technique = make_technique(configuration);
      s.renderer = std::make_unique<Renderer>(session_.scene, session_.gl.capabilities,
                                              session_.renderer.shared_scene_buffers());
      s.renderer->prepare(*s.technique, s.frame.size.width_px, s.frame.size.height_px, s.frame.lights);
    } catch (const UsageError&) {
      throw;  // a mistake in the sweep, not of the machine
    } catch (const Error& e) {
      s.failed = e.what();
      s.renderer.reset();
    }
  }
}

RenderedFrame Subjects::rendered(Subject& s) {
  return {session_.scene, s.frame, session_.gl, *s.renderer, *s.technique, s.timers};
}

void Subjects::render(Subject& s, bool measured) {
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  s.renderer->render(s.frame.camera, s.frame.lights, s.timers);
  glFinish();
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const Milliseconds elapsed = std::chrono::steady_clock::now() - start;
  s.timers.collect();
  if (measured) {
    s.frame_ms.push_back(elapsed.count());
    s.started_ms.push_back(Milliseconds(start - start_).count());
  } else {
    s.timers.clear();
  }
}

void Subjects::round(bool measured) {
  // Each round begins with another, so that none always follows the same neighbour's traces in the caches.
  std::vector<Subject*> order;
  for (Subject& s : subjects_) order.push_back(&s);
  if (!order.empty()) std::rotate(order.begin(), order.begin() + long(rounds_ % order.size()), order.end());
  for (Subject* s : order) {
    if (!s->works()) continue;
    try {
      render(*s, measured);
      for (size_t light = 0; !measured && light < s->renderer->light_count(); ++light)
        s->renderer->read_mask(light);  // throws where the technique says that it is wrong
    } catch (const Error& e) {
      s->failed = e.what();
    }
  }
  ++rounds_;
}

void Subjects::move_to(double time_s) {
  session_.move_to(time_s);
  look(session_.frame.camera, session_.frame.lights);
}

void Subjects::look(const Camera& camera, const std::vector<Light>& lights) {
  for (Subject& s : subjects_) {
    s.frame.camera = camera;
    s.frame.lights = lights;
  }
}

nlohmann::json Subjects::results(bool counted) {
  nlohmann::json list = nlohmann::json::array();
  for (Subject& s : subjects_) {
    nlohmann::json result = description(s);
    if (s.works()) try {
        result["stages"] = stages_json(s.timers);
        if (!s.frame_ms.empty()) {
          result["frame_ms"] = median(s.frame_ms);
          result["frame_samples"] = s.frame_ms;
          result["frame_started_ms"] = s.started_ms;
        }
        if (counted) {
          result.update(masks_json(rendered(s)));
          result.update(memory_json(*s.renderer));
          add_statistics(result, rendered(s), false);
        }
      } catch (const Error& e) {
        s.failed = e.what();
        result = description(s);
      }
    if (!s.works()) result["failed"] = s.failed;
    if (s.inapplicable) result["inapplicable"] = true;
    list.push_back(std::move(result));
  }
  return list;
}

}  // namespace izb::bench

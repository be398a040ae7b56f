// SPDX-License-Identifier: MIT
#include "app/frame_options.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <set>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "base/shipped.h"
#include "gpu/context.h"
#include "scene/find.h"

namespace izb {
namespace {

constexpr double default_azimuth_deg = 135.0, default_elevation_deg = 40.0;

std::vector<double> parse_numbers(const std::string& option, const std::string& text, size_t count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at <= end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) break;
    numbers.push_back(value);
    if (next == end) {
      if (numbers.size() == count) return numbers;
      break;
    }
    if (*next != ',') break;
    at = next + 1;
  }
  throw UsageError(fmt::format("--{} must be {} numbers with commas between them, not '{}'", option, count, text));
}

Light parse_sun(const std::string& text) {
  const std::vector<double> n = parse_numbers("sun", text, 2);
  if (n[1] < -90.0 || n[1] > 90.0)
    throw UsageError(fmt::format("--sun's elevation must be between -90 and 90 degrees, not {}", n[1]));
  return sun(n[0], n[1]);
}

Light parse_spot(const std::string& text) {
  const std::vector<double> n = parse_numbers("spot", text, 7);
  if (!(n[6] > 0.0 && n[6] <= 90.0))
    throw UsageError(fmt::format("--spot's half-angle must be above 0 and at most 90 degrees, not {}", n[6]));
  Light light;
  light.name = "spot";
  light.type = LightType::spot;
  light.position_ws = {n[0], n[1], n[2]};
  const glm::dvec3 way = glm::dvec3(n[3], n[4], n[5]) - light.position_ws;
  if (!(glm::length(way) > 0.0)) throw UsageError("--spot's target must differ from its position");
  light.direction_ws = glm::normalize(way);
  light.outer_cone_rad = glm::radians(n[6]);
  light.inner_cone_rad = 0.9 * light.outer_cone_rad;
  return light;
}

Light parse_point(const std::string& text) {
  Light light;
  light.name = "point";
  light.type = LightType::point;
  light.position_ws = parse_vector("point", text);
  return light;
}

/// The views that come with the program, if the path as given is theirs and is not there.
std::filesystem::path find_views(const std::string& given) {
  std::error_code ignored;
  if (given != "bench/views.json" || std::filesystem::exists(given, ignored)) return given;
  return shipped_path("views.json", given);
}

Camera choose_camera(const FrameOptions& o, const Scene& scene, const std::optional<Viewpoint>& viewpoint) {
  if (!o.eye.empty()) {
    const glm::dvec3 eye = parse_vector("eye", o.eye), target = parse_vector("target", o.target);
    if (eye == target) throw UsageError("--eye and --target must differ");
    return look_at(eye, target, glm::radians(o.fov_deg));
  }
  if (!o.camera.empty()) return find_camera(scene, o.camera);
  if (viewpoint) return look_at(viewpoint->eye_ws, viewpoint->target_ws, glm::radians(viewpoint->yfov_deg));
  if (!scene.cameras.empty()) return scene.cameras.front();
  note("the scene has no camera: one framed on its bounds is used (--eye, --target, --fov choose another)");
  return default_camera(world_bounds(scene));
}

/// Lights of the scene by a list of names or indices, or "all"; a light whose own name looks like a list counts as one.
std::vector<Light> scene_lights(const Scene& scene, const std::string& text) {
  const auto is_called = [&](const std::string& name) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& l) { return l.name == name; });
  };
  if (text == "all" && !is_called("all") && !scene.lights.empty()) return scene.lights;
  if (is_called(text)) return {find_light(scene, text)};
  std::vector<Light> lights;
  for (const std::string& name : list_of(text)) lights.push_back(find_light(scene, name));
  return lights;
}

/// A lamp from the command line is as strong as a sun at half the scene's radius.
void set_strength(std::vector<Light>& lamps, const Scene& scene) {
  if (lamps.empty()) return;
  const double radius = world_bounds(scene).radius(), reach = radius > 0.0 ? 0.5 * radius : 1.0;
  for (Light& lamp : lamps) lamp.intensity = static_cast<float>(reach * reach);
}

/// A unit vector as it is, so that one that was printed in full comes back.
glm::dvec3 unit(const glm::dvec3& v) {
  if (std::abs(glm::dot(v, v) - 1.0) <= 8.0 * std::numeric_limits<double>::epsilon()) return v;
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));  // whose square may overflow
}

/// Where --light-position and --light-direction put the lights that --light chose.
std::vector<LightPlace> light_places(const FrameOptions& o, std::span<const Light> lights) {
  std::vector<LightPlace> places(lights.size());
  const auto each = [&](const std::string& option, const std::string& text, LightType refused, const char* reason,
                        auto&& put) {
    const std::vector<std::string> entries = list_of(text);
    if (entries.size() > lights.size())
      throw UsageError(
          fmt::format("--{} has {} entries, but --light chooses {} lights", option, entries.size(), lights.size()));
    for (size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].empty()) continue;
      if (lights[i].type == refused)
        throw UsageError(fmt::format("--{} cannot move the light '{}': {}", option, lights[i].name, reason));
      put(places[i], parse_vector(option, entries[i]));
    }
  };
  each("light-position", o.light_position, LightType::directional, "a directional light has no position",
       [](LightPlace& place, const glm::dvec3& position_ws) { place.position_ws = position_ws; });
  each("light-direction", o.light_direction, LightType::point, "a point light shines in all directions",
       [](LightPlace& place, const glm::dvec3& direction_ws) {
         if (direction_ws == glm::dvec3(0.0)) throw UsageError("--light-direction must not be 0,0,0");
         place.direction_ws = unit(direction_ws);
       });
  return places;
}

/// Channels and hashes go by the names.
void make_names_unique(std::vector<Light>& lights) {
  std::set<std::string> taken;
  for (Light& light : lights) {
    const std::string name = light.name.empty() ? type_name(light.type) : light.name;
    light.name = name;
    for (int n = 2; !taken.insert(layer_name(light.name)).second; ++n) light.name = fmt::format("{} {}", name, n);
  }
}

std::vector<Light> choose_lights(const FrameOptions& o, const Scene& scene, const std::optional<Viewpoint>& viewpoint) {
  std::vector<Light> lights, lamps;
  if (!o.light.empty()) lights = scene_lights(scene, o.light);
  for (const std::string& text : list_of(o.sun)) lights.push_back(parse_sun(text));
  for (const std::string& text : list_of(o.spot)) lamps.push_back(parse_spot(text));
  for (const std::string& text : list_of(o.point)) lamps.push_back(parse_point(text));
  set_strength(lamps, scene);
  lights.insert(lights.end(), lamps.begin(), lamps.end());
  if (!lights.empty()) return lights;
  if (viewpoint && viewpoint->light) return {find_light(scene, *viewpoint->light)};
  if (viewpoint && viewpoint->sun_deg) return {sun(viewpoint->sun_deg->x, viewpoint->sun_deg->y)};
  if (scene.lights.size() > 1)
    note("of the scene's {} lights '{}' is used (--light all takes all)", scene.lights.size(), scene.lights[0].name);
  if (!scene.lights.empty()) return {scene.lights.front()};
  note("the scene has no light: a sun at azimuth {} and elevation {} degrees is used (--sun chooses another)",
       default_azimuth_deg, default_elevation_deg);
  return {sun(default_azimuth_deg, default_elevation_deg)};
}

}  // namespace

std::string layer_name(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

glm::dvec3 parse_vector(const std::string& option, const std::string& text) {
  const std::vector<double> n = parse_numbers(option, text, 3);
  return {n[0], n[1], n[2]};
}

OptionSet FrameOptions::options(bool with_technique) {
  OptionSet set;
  set.text("size", size, "WIDTHxHEIGHT", "size of the picture in pixels");
  set.text("camera", camera, "NAME|INDEX",
           "a camera of the scene; without one, its first, or one framed on its bounds");
  set.text("eye", eye, "X,Y,Z", "camera position in world units, with --target");
  set.text("target", target, "X,Y,Z", "the point that the camera looks at, in world units");
  set.text("camera-path", camera_path, "FILE",
           "key frames that the camera flies through, as JSON; --time or the frame's number chooses the moment");
  set.number("fov", fov_deg, 0.1, 170.0, "degrees", "vertical field of view, with --eye");
  set.text("light", light, "NAME|INDEX|all",
           "a light of the scene, or several with semicolons between them, or all; without any light, the scene's "
           "first, or a sun. --sun, --spot and --point take several in the same way and may be given together");
  set.text("light-position", light_position, "X,Y,Z",
           "moves the lights that --light chooses, in that order with semicolons between them, to positions in world "
           "units, wherever the scene has them; nothing between two semicolons leaves a light where it is");
  set.text("light-direction", light_direction, "X,Y,Z",
           "turns them in the same way: the direction in which the light shines, of any length");
  set.text("sun", sun, "AZIMUTH,ELEVATION",
           "a directional light: degrees clockwise from -z, degrees above the horizon");
  set.text("spot", spot, "X,Y,Z,TX,TY,TZ,ANGLE",
           "a spot light: position, target (world units), half-angle (degrees, up to 90)");
  set.text("point", point, "X,Y,Z", "a light that shines all around: position in world units");
  set.text("viewpoint", viewpoint, "NAME", "a named view of the views file: camera and light");
  set.number("time", time_s, -1.0, std::numeric_limits<double>::infinity(), "seconds",
             "the moment of the animation and of the camera path; -1: meshes at rest, or the beginning where "
             "--animation or --frames is given");
  set.text("animation", animation, "NAME|INDEX|all",
           "an animation of the scene, or several with semicolons between them, or all; with --time alone its first");
  set.flag("loop", loop, "an animation begins again at its end");
  set.text("views", views, "FILE", "the views file");
  if (with_technique) {
    set.choice("technique", technique, technique_names(), "the shadow technique; its own options are listed below");
    set.text("preset", preset, "NAME",
             "the technique's options as a whole, others on the command line still count: izb has paper (table 1), "
             "exact, and fast, which leaks a little");
  }
  set.choice("context", context, gpu::context_names(), "how to get an OpenGL 4.5 context");
  return set;
}

bool FrameOptions::plays() const {
  return time_s >= 0.0 || !animation.empty();
}

Size Size::scaled(double scale) const {
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  return {side(width_px), side(height_px)};
}

Size parse_size(const std::string& text) {
  Size size{0, 0};
  const char* const end = text.data() + text.size();
  const auto [after_width, error1] = std::from_chars(text.data(), end, size.width_px);
  if (error1 == std::errc() && after_width != end && *after_width == 'x') {
    const auto [after_height, error2] = std::from_chars(after_width + 1, end, size.height_px);
    if (error2 == std::errc() && after_height == end && size.width_px > 0 && size.height_px > 0) return size;
  }
  throw UsageError(fmt::format("--size must be WIDTHxHEIGHT in pixels, each at least 1, not '{}'", text));
}

void FrameChoice::move(const Poser& poser, double time_s) {
  if (path) {
    const glm::dvec2 pixel_shift = camera.pixel_shift;
    camera = path->at(time_s);
    camera.pixel_shift = pixel_shift;
  } else {
    poser.place(camera);
  }
  for (Light& light : lights) poser.place(light);
  place_lights();
}

void FrameChoice::place_lights() {
  for (size_t i = 0; i < places.size(); ++i) {
    if (places[i].position_ws) lights[i].position_ws = *places[i].position_ws;
    if (places[i].direction_ws) lights[i].direction_ws = *places[i].direction_ws;
  }
}

FrameChoice choose_frame(const FrameOptions& o, const Scene& scene) {
  if (o.eye.empty() != o.target.empty()) throw UsageError("--eye and --target go together");
  if (o.light.empty() && !(o.light_position.empty() && o.light_direction.empty()))
    throw UsageError("--light-position and --light-direction move lights of the scene: --light must say which");
  if (!o.eye.empty() + !o.camera.empty() + !o.camera_path.empty() > 1)
    throw UsageError("--camera, --eye and --camera-path exclude each other");
  std::optional<Viewpoint> viewpoint;
  if (!o.viewpoint.empty()) viewpoint = read_viewpoint(find_views(o.views), o.viewpoint);
  FrameChoice choice{parse_size(o.size), {}, {}, choose_lights(o, scene, viewpoint)};
  const size_t chosen = o.light.empty() ? 0 : scene_lights(scene, o.light).size();
  choice.places = light_places(o, std::span(choice.lights).first(chosen));
  choice.place_lights();
  if (!o.camera_path.empty()) choice.path = read_camera_path(o.camera_path);
  choice.camera = choice.path ? choice.path->at(std::max(o.time_s, 0.0)) : choose_camera(o, scene, viewpoint);
  make_names_unique(choice.lights);
  return choice;
}

}  // namespace izb

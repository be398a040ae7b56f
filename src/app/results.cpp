// SPDX-License-Identifier: MIT
#include "app/results.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "base/json_text.h"
#include "base/log.h"
#include "base/machine_memory.h"
#include "base/sha256.h"
#include "base/version.h"
#include "frame/read_back.h"

namespace izb {
namespace {

static_assert(std::endian::native == std::endian::little, "the mask's hash is over little-endian words");

std::string command_line(const Arguments& arguments) {
  std::string text = "izb";
  for (const std::string& a : arguments) text += " " + (a.find(' ') == std::string::npos ? a : "'" + a + "'");
  return text;
}

std::array<float, 16> floats_of(const glm::dmat4& m) {
  const glm::mat4 f(m);
  std::array<float, 16> out;
  std::memcpy(out.data(), &f[0][0], sizeof f);
  return out;
}

/// OpenEXR's camera space looks along +z; its NDC runs from the upper left corner (0, 0) to the lower right (1, 1).
void add_camera(Image& image, const RenderedFrame& rendered) {
  const glm::dmat4 view = glm::inverse(rendered.frame.camera.world_from_view);
  const Size size = rendered.frame.size;
  const glm::dmat4 clip(make_camera_frame(rendered.frame.camera, size.width_px, size.height_px).clip_from_view);
  const glm::dmat4 upper_left =
      glm::translate(glm::dmat4(1.0), {0.5, 0.5, 0.0}) * glm::scale(glm::dmat4(1.0), {0.5, -0.5, 1.0});
  image.attributes["worldToCamera"] = floats_of(glm::scale(glm::dmat4(1.0), {1.0, 1.0, -1.0}) * view);
  image.attributes["worldToNDC"] = floats_of(upper_left * clip * view);
}

void add_light(Image& image, const Light& light, const std::string& suffix) {
  const auto triple = [](const glm::dvec3& v) { return std::array<float, 3>{float(v.x), float(v.y), float(v.z)}; };
  const std::string prefix = "light" + suffix + ".";
  image.attributes[prefix + "type"] = std::string(type_name(light.type));
  if (light.type != LightType::point) image.attributes[prefix + "direction"] = triple(light.direction_ws);
  image.attributes[prefix + "color"] = triple(glm::dvec3(light.color));
  image.attributes[prefix + "intensity"] = light.intensity;
  if (light.type != LightType::directional) image.attributes[prefix + "position"] = triple(light.position_ws);
  if (light.type == LightType::spot) {
    image.attributes[prefix + "halfAngleDegrees"] = float(glm::degrees(light.outer_cone_rad));
    image.attributes[prefix + "innerHalfAngleDegrees"] = float(glm::degrees(light.inner_cone_rad));
  }
}

}  // namespace

nlohmann::json origin_json(const Arguments& arguments) {
  return {{"command", command_line(arguments)}, {"version", fmt::format("{} ({})", version(), commit())}};
}

std::string channel_suffix(std::span<const Light> lights, size_t light) {
  return lights.size() == 1 ? std::string() : "." + layer_name(lights[light].name);
}

nlohmann::json provenance(const RenderedFrame& rendered, const FrameOptions& options, const Arguments& arguments,
                          const std::string& scene_path) {
  FrameOptions copy = options;
  nlohmann::json facts = origin_json(arguments);
  facts["gl"] = {{"context", rendered.gl.context.name},
                 {"vendor", rendered.gl.capabilities.vendor},
                 {"renderer", rendered.gl.capabilities.renderer},
                 {"version", rendered.gl.capabilities.version}};
  facts["options"] = copy.options().to_json();
  facts["options"].update(rendered.technique.options().to_json());
  facts["technique"] = rendered.technique.info().name;
  facts["scene"] = {{"file", scene_path},
                    {"triangles", rendered.scene.triangle_count()},
                    {"geometry_bytes", rendered.scene.geometry_bytes()}};
  facts["timing"] = rendered.timers.method();
  return facts;
}

std::string mask_hash(std::span<const std::vector<uint32_t>> masks) {
  std::vector<uint32_t> all;
  for (const std::vector<uint32_t>& mask : masks) all.insert(all.end(), mask.begin(), mask.end());
  return sha256_hex(std::as_bytes(std::span(all)));
}

nlohmann::json masks_json(const RenderedFrame& rendered) {
  std::vector<std::vector<uint32_t>> masks;
  nlohmann::json lights = nlohmann::json::array();
  for (size_t i = 0; i < rendered.renderer.light_count(); ++i) {
    masks.push_back(rendered.renderer.read_mask(i));
    lights.push_back({{"name", rendered.frame.lights[i].name},
                      {"type", type_name(rendered.frame.lights[i].type)},
                      {"mask_hash", mask_hash({&masks.back(), 1})}});
  }
  return {{"mask_hash", mask_hash(masks)}, {"lights", lights}, {"exposure", rendered.renderer.exposure()}};
}

Image frame_image(const RenderedFrame& rendered, const nlohmann::json& facts) {
  const FrameInputs& in = rendered.renderer.inputs();
  const GBufferImage gbuffer = read_gbuffer(*in.gbuffer);
  Image image;
  image.width_px = in.width_px;
  image.height_px = in.height_px;
  const size_t count = gbuffer.size();

  std::vector<glm::vec4> picture(count);
  rendered.renderer.picture().read_bytes(GL_RGBA, GL_FLOAT, count * sizeof(glm::vec4), picture.data());
  picture = flip_rows(std::move(picture), in.width_px, in.height_px);
  const auto plane = [&](const std::string& name, auto&& value) {
    std::vector<float> values(count);
    for (size_t i = 0; i < count; ++i) values[i] = value(i);
    image.add(name, std::move(values));
  };
  plane("R", [&](size_t i) { return picture[i].r; });
  plane("G", [&](size_t i) { return picture[i].g; });
  plane("B", [&](size_t i) { return picture[i].b; });
  plane("depth", [&](size_t i) { return gbuffer.eye_distance[i]; });
  std::vector<glm::vec3> normals(count, glm::vec3(0.0f));
  const glm::mat3 world_from_view = glm::mat3(rendered.frame.camera.world_from_view);
  for (size_t i = 0; i < count; ++i)
    if (gbuffer.eye_distance[i] > 0.0f) normals[i] = world_from_view * shared::octahedral_decode(gbuffer.normal[i]);
  plane("normal.X", [&](size_t i) { return normals[i].x; });
  plane("normal.Y", [&](size_t i) { return normals[i].y; });
  plane("normal.Z", [&](size_t i) { return normals[i].z; });
  for (size_t light = 0; light < rendered.renderer.light_count(); ++light) {
    const std::string suffix = channel_suffix(rendered.frame.lights, light);
    std::vector<uint32_t> mask = rendered.renderer.read_mask(light);
    plane("visibility" + suffix, [&](size_t i) { return 1.0f - float(std::popcount(mask[i])) / 32.0f; });
    if (std::vector<float> lengths = rendered.renderer.list_lengths(light); !lengths.empty())
      image.add("list_length" + suffix, flip_rows(std::move(lengths), in.width_px, in.height_px));
    image.add("mask" + suffix, std::move(mask));
  }
  add_attributes(image, rendered, facts);
  return image;
}

void add_attributes(Image& image, const RenderedFrame& rendered, const nlohmann::json& facts) {
  const std::vector<Light>& lights = rendered.frame.lights;
  for (size_t light = 0; light < lights.size(); ++light) add_light(image, lights[light], channel_suffix(lights, light));
  add_camera(image, rendered);
  for (const auto& [key, value] : facts.items())
    image.attributes["izb." + key] = value.is_string() ? value.get<std::string>() : json_text(value);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

nlohmann::json stages_json(const gpu::StageTimers& timers) {
  nlohmann::json list = nlohmann::json::array();
  for (const gpu::StageTimers::Stage& stage : timers.stages())
    list.push_back({{"name", stage.name}, {"gpu_ms", median(stage.samples_ms)}, {"samples", stage.samples_ms}});
  return list;
}

nlohmann::json counts_json(const Counts& counts) {
  nlohmann::json object = nlohmann::json::object();
  for (const auto& [name, value] : counts) object[name] = value;
  return object;
}

nlohmann::json memory_json(const Renderer& renderer) {
  nlohmann::json json{{"memory_bytes", counts_json(renderer.memory())},
                      {"memory_available_bytes", nullptr},
                      {"memory_peak_bytes", nullptr}};
  if (const auto peak = peak_process_memory()) json["memory_peak_bytes"] = *peak;
  if (renderer.room().bytes) json["memory_available_bytes"] = *renderer.room().bytes;
  return json;
}

std::string memory_line(const nlohmann::json& json) {
  Counts groups;
  uint64_t sum = 0;
  for (const auto& [name, bytes] : json["memory_bytes"].items()) {
    groups.emplace_back(name, bytes.get<uint64_t>());
    sum += groups.back().second;
  }
  std::string line = fmt::format("memory: {}; {}", gpu::describe(groups), gpu::megabytes(sum));
  if (const nlohmann::json& room = json["memory_available_bytes"]; !room.is_null())
    line += fmt::format(" of {} available", gpu::megabytes(room.get<uint64_t>()));
  return line;
}

}  // namespace izb

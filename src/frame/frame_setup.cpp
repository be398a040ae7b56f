// SPDX-License-Identifier: MIT
#include "frame/frame_setup.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "frame/deform.h"

namespace izb {
namespace {

// Above it one plane would need too many texels at its border.
constexpr double largest_half_angle_of_one_grid_deg = 60.0;

glm::vec4 with_w(const glm::dvec3& v, double w) {
  return glm::vec4(glm::dvec4(v, w));
}

}  // namespace

shared::CameraFrame make_camera_frame(const Camera& camera, int width_px, int height_px) {
  const double width = width_px, height = height_px, aspect = width / height;
  const double half_height = camera.orthographic ? camera.ymag : std::tan(0.5 * camera.yfov_rad);
  const double half_width = half_height * aspect;
  const double near = camera.near_plane, far = camera.far_plane;
  glm::dmat4 clip(0.0);
  clip[0][0] = 1.0 / half_width;
  clip[1][1] = 1.0 / half_height;
  if (camera.orthographic) {
    clip[2][2] = 1.0 / (far - near);
    clip[3][2] = far / (far - near);
    clip[3][3] = 1.0;
  } else {
    const bool infinite = std::isinf(far);
    clip[2][2] = infinite ? 0.0 : near / (far - near);
    clip[3][2] = infinite ? near : near * far / (far - near);
    clip[2][3] = -1.0;
  }
  shared::CameraFrame frame;
  // What a pixel's shifted ray meets goes to the pixel's centre.
  const glm::dvec2 shift_ndc = 2.0 * camera.pixel_shift / glm::dvec2(width, height);
  for (int axis = 0; axis < 2; ++axis)
    clip[camera.orthographic ? 3 : 2][axis] = camera.orthographic ? 0.0 - shift_ndc[axis] : shift_ndc[axis];
  frame.clip_from_view = glm::mat4(clip);
  const glm::dvec2 pixel(2.0 * half_width / width, 2.0 * half_height / height);
  const glm::dvec2 corner = camera.pixel_shift * pixel - glm::dvec2(half_width, half_height);
  frame.pixel_ray = glm::vec4(glm::dvec4(pixel, corner));
  frame.footprint = camera.orthographic ? glm::vec4(0.0, pixel.y, 0.0, 0.0) : glm::vec4(pixel.y, 0.0, 1.0, 0.0);
  frame.size_px = glm::uvec4(width_px, height_px, 0, 0);
  return frame;
}

int grid_faces(const Light& light, const GridRequest& grid) {
  if (light.type == LightType::directional) return 1;
  const bool one_will_do =
      light.type == LightType::spot && light.outer_cone_rad <= glm::radians(largest_half_angle_of_one_grid_deg) + 1e-6;
  return one_will_do && !grid.whole_micro_quads ? 1 : shared::cube_faces;
}

shared::LightFrame make_light_frame(const Camera& camera, const shared::CameraFrame& camera_frame, const Light& light,
                                    const GridRequest& grid) {
  const bool positional = light.type != LightType::directional;
  const glm::dmat4 view_from_world = glm::inverse(camera.world_from_view);
  const glm::dmat3 axes = grid.world_axes ? glm::dmat3(view_from_world) : glm::dmat3(1.0);
  const glm::dvec3 forward = axes * glm::dvec3(0.0, 0.0, -1.0), up = axes * glm::dvec3(0.0, 1.0, 0.0);
  // A point light has no direction: its cube stands along the view.
  const glm::dvec3 z =
      light.type == LightType::point ? forward : glm::normalize(glm::dmat3(view_from_world) * light.direction_ws);
  // The grid's x axis follows the view as seen from the light, so that the window is tight around the view frustum.
  const glm::dvec3 hint = std::abs(glm::dot(forward, z)) < 0.99 ? forward : up;
  const glm::dvec3 x = glm::normalize(hint - z * glm::dot(hint, z));
  const glm::dvec3 y = glm::cross(z, x);
  shared::LightFrame frame;
  const glm::dvec3 position =
      positional ? glm::dvec3(view_from_world * glm::dvec4(light.position_ws, 1.0)) : glm::dvec3(0.0);
  const double away = glm::length(position);
  const double band = positional ? shared::pixel_width(camera_frame, float(away)) / 64.0 + 16.0 * 0x1p-24 * away : 0.0;
  frame.axis_x = with_w(x, band);
  frame.axis_y = with_w(y, grid.density);
  frame.axis_z = with_w(z, 0.0);
  frame.origin = with_w(position, positional ? 1.0 : 0.0);
  const double cone = light.type == LightType::spot ? std::max(std::cos(light.outer_cone_rad), 0.0) : -1.0;
  frame.to_light = with_w(-glm::dvec3(glm::vec3(frame.axis_z)), cone);
  frame.color = glm::vec4(light.color, grid.nl_cull ? 1.0f : 0.0f);
  frame.grid = glm::uvec4(grid.texels, grid.cascades, grid_faces(light, grid), 0);
  return frame;
}

std::vector<shared::InstanceFrame> make_instance_frames(const Camera& camera, const Scene& scene,
                                                        const DrawList& list) {
  const glm::dmat4 view_from_world = glm::inverse(camera.world_from_view);
  std::vector<shared::InstanceFrame> frames;
  frames.reserve(list.parts.size());
  for (const DrawPart& part : list.parts) {
    const Instance& instance = scene.instances[part.instance];
    const glm::mat4 rows = glm::mat4(glm::transpose(view_from_world * instance.world_from_object));
    frames.push_back(
        {rows[0], rows[1], rows[2],
         glm::uvec4(part.first_triangle, scene.meshes[instance.mesh].material, part.first_index, part.base_vertex)});
  }
  return frames;
}

std::vector<shared::MaterialFrame> make_materials(const Scene& scene, const AlphaMaps& maps) {
  std::vector<shared::MaterialFrame> frames;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    const glm::mat3 rows = glm::transpose(m.uv_transform);
    // Rounded to a float, so that an alpha of n / 255 passes a cut-off of n / 255.
    const float cutoff = m.alpha_cutoff * 255.0f;
    frames.push_back({m.base_color, glm::vec4(rows[0], cutoff), glm::vec4(rows[1], 0.0f), maps.of_material[i]});
  }
  return frames;
}

shared::SampleFrame make_sample_frame(const SamplePattern& samples, const GridRequest& grid) {
  shared::SampleFrame frame{};
  for (size_t i = 0; i < samples.offsets_px.size(); ++i)
    frame.offset_px[i] = glm::vec4(samples.offsets_px[i], 0.0f, 0.0f);
  frame.info = glm::uvec4(samples.count(), grid.table_side, 0, 0);
  return frame;
}

bool exposure_is_measured(const std::vector<Light>& lights) {
  return std::any_of(lights.begin(), lights.end(), [](const Light& l) { return l.type != LightType::directional; });
}

std::vector<double> shade_weights(const std::vector<Light>& lights) {
  double sum = 0.0;
  for (const Light& light : lights) sum += double(light.intensity);
  const double share = exposure_is_measured(lights) || !(sum > 0.0) ? 1.0 : 1.0 / sum;
  std::vector<double> weights;
  for (const Light& light : lights) weights.push_back(double(light.intensity) * share);
  return weights;
}

shared::ShadeFrame make_shade_frame(const Camera& camera, const Light& light, double weight) {
  const glm::dvec3 up = glm::transpose(glm::dmat3(camera.world_from_view)) * glm::dvec3(0.0, 1.0, 0.0);
  constexpr double ambient = 0.35;
  shared::ShadeFrame frame;
  frame.up_vs = with_w(up, ambient);
  frame.sky_horizon = glm::vec4(0.80f, 0.85f, 0.90f, 0.0f);
  frame.sky_zenith = glm::vec4(0.30f, 0.47f, 0.75f, 0.0f);
  frame.ground = glm::vec4(0.30f, 0.28f, 0.26f, 0.0f);
  const bool spot = light.type == LightType::spot;
  frame.cone = spot ? glm::vec4(std::cos(light.inner_cone_rad), std::cos(light.outer_cone_rad), 0.0, 0.0)
                    : glm::vec4(-1.0f, -2.0f, 0.0f, 0.0f);  // lights every direction
  frame.strength = glm::vec4(weight, light.range > 0.0 ? 1.0 / light.range : 0.0, 0.0, 0.0);
  return frame;
}

std::vector<glm::vec3> flatten(const Scene& scene, const DrawList& list,
                               const std::vector<shared::InstanceFrame>& instances) {
  std::vector<glm::vec3> positions;
  positions.reserve(size_t(list.triangle_count) * 3);
  std::vector<glm::vec3> moved;
  for (size_t i = 0; i < instances.size(); ++i) {
    const DrawPart& part = list.parts[i];
    const Instance& instance = scene.instances[part.instance];
    if (i == 0 || part.instance != list.parts[i - 1].instance) {
      moved = deformed_positions(scene, instance);
      for (glm::vec3& p : moved) p = shared::view_from_object(instances[i], p);
    }
    const uint32_t* const indices = scene.meshes[instance.mesh].indices.data() + 3 * size_t(part.mesh_triangle);
    for (uint32_t k = 0; k < 3 * part.triangle_count; ++k) positions.push_back(moved[indices[k]]);
  }
  return positions;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "shadow/shadow_map/fixed_windows.h"

#include <algorithm>
#include <cmath>

namespace izb {
namespace {

constexpr double none = 3.0e38;

/// The frame's camera, and how far its rays are shifted within their pixels: windows follow from what it sees without.
struct View {
  const shared::CameraFrame& frame;
  glm::dvec2 shift_px;

  /// Half of what the camera sees at eye distance t.
  glm::dvec2 half_size(double t) const {
    const glm::dvec4 ray(frame.pixel_ray);
    const glm::dvec2 half = shift_px * glm::dvec2(ray.x, ray.y) - glm::dvec2(ray.z, ray.w);
    return shared::is_perspective(frame) ? half * t : half;
  }
};

struct Box {
  glm::dvec3 low{none}, high{-none};
  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// In double, as shared::light_position.
glm::dvec3 light_from_view(const shared::LightFrame& light, const glm::dvec3& p_vs) {
  return {glm::dot(glm::dvec3(light.axis_x), p_vs), glm::dot(glm::dvec3(light.axis_y), p_vs),
          glm::dot(glm::dvec3(light.axis_z), p_vs)};
}

/// All but one texel at each border and the filter's margin there.
shared::LightWindow window_of(const Box& box, double side, double margin) {
  const glm::dvec3 extent = glm::max(box.high - box.low, 1e-6 * glm::max(glm::abs(box.low), glm::abs(box.high)));
  const glm::dvec2 scale = (side - 2.0 - 2.0 * margin) / glm::dvec2(extent);
  const double depth_scale = 0.5 / extent.z;
  shared::LightWindow w{};
  w.window = glm::vec4(glm::dvec4(glm::dvec2(box.low) - (1.0 + margin) / scale, scale));
  w.depth = glm::vec4(0.25 - box.low.z * depth_scale, depth_scale, 0.0, 0.0);
  w.guard = glm::vec4(0.0f, float(side), 0.0f, 0.0f);
  return w;
}

Box slice_box(const View& view, const shared::LightFrame& light, double t0, double t1) {
  Box box;
  for (const double t : {t0, t1})
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const glm::dvec2 half = view.half_size(t);
        box.add(light_from_view(light, {x * half.x, y * half.y, -t}));
      }
  return box;
}

/// The box of the slice's smallest sphere around a point of the view's axis, moved to whole texels of the world.
Box stable_box(const Camera& camera, const View& view, const shared::LightFrame& light, double t0, double t1,
               double texels) {
  const double near2 = glm::dot(view.half_size(t0), view.half_size(t0));
  const double far2 = glm::dot(view.half_size(t1), view.half_size(t1));
  const double center = std::min(t1, 0.5 * (t0 + t1) + 0.5 * (far2 - near2) / std::max(t1 - t0, 1e-12));
  const double radius =
      std::sqrt(std::max(far2 + (t1 - center) * (t1 - center), near2 + (center - t0) * (center - t0)));
  const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(camera.world_from_view));
  const glm::dvec3 eye = light_from_view(light, view_from_world * glm::dvec3(camera.world_from_view[3]));
  const glm::dvec3 middle = light_from_view(light, {0.0, 0.0, -center});
  // One texel more than the sphere takes, since it lies anywhere between two steps.
  const double texel = 2.0 * radius / (texels - 1.0);
  Box box;
  box.low = middle - radius;
  for (int axis = 0; axis < 2; ++axis)
    box.low[axis] = std::floor((box.low[axis] + eye[axis]) / texel) * texel - eye[axis];
  box.high = box.low + texels * texel;
  box.high.z = box.low.z + 2.0 * radius;
  return box;
}

}  // namespace

std::vector<double> split_frustum(double near, double distance, double lambda, int cascades) {
  std::vector<double> ends;
  for (int i = 1; i <= cascades; ++i) {
    const double share = double(i) / cascades;
    const double logarithmic = near > 0.0 ? near * std::pow(distance / near, share) : distance * share;
    ends.push_back(lambda * logarithmic + (1.0 - lambda) * (near + (distance - near) * share));
  }
  return ends;
}

FixedWindows make_fixed_windows(const Camera& camera, const shared::CameraFrame& frame, const shared::LightFrame& light,
                                const FixedFit& fit) {
  const int cascades = static_cast<int>(light.grid.y), faces = static_cast<int>(light.grid.z);
  const double side = light.grid.x, margin = fit.margin_texels;
  const double near = std::max(0.0, camera.near_plane), distance = std::max(fit.distance, near * (1.0 + 1e-6));
  FixedWindows fixed;
  for (int i = 0; i < shared::max_cascades; ++i) fixed.range.ends[i / 4][i % 4] = float(none);
  if (shared::is_positional(light)) {
    const double cosine = std::max(double(light.to_light.w), 0.5);
    const double reach = faces > 1 ? 1.0 + 1e-5 : std::sqrt(1.0 - cosine * cosine) / cosine * (1.0 + 1e-5);
    // Depths -1/z: all that is further from the light than a thousandth of what is seen.
    Box box;
    box.add({-reach, -reach, -1024.0 / distance});
    box.add({reach, reach, 0.0});
    for (int face = 0; face < faces; ++face)
      fixed.windows[static_cast<size_t>(face * cascades)] = window_of(box, side, margin);
    return fixed;
  }
  const View view{frame, camera.pixel_shift};
  const std::vector<double> ends = split_frustum(near, distance, fit.lambda, cascades);
  double start = near;
  for (int i = 0; i < cascades; ++i) {
    const double end = ends[static_cast<size_t>(i)];
    const Box box = fit.stable ? stable_box(camera, view, light, start, end, side - 2.0 - 2.0 * margin)
                               : slice_box(view, light, start, end);
    fixed.windows[static_cast<size_t>(i)] = window_of(box, side, margin);
    if (i < cascades - 1) fixed.range.ends[i / 4][i % 4] = float(end);
    start = end;
  }
  return fixed;
}

double distance_of_end(const Camera& camera, const Bounds& world) {
  double furthest = 0.0;
  if (world.empty()) return 1.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? world.max.x : world.min.x, corner & 2 ? world.max.y : world.min.y,
                       corner & 4 ? world.max.z : world.min.z);
    furthest = std::max(furthest, -glm::dot(glm::dvec3(camera.world_from_view[2]),
                                            glm::dvec3(p) - glm::dvec3(camera.world_from_view[3])));
  }
  return furthest > 0.0 ? std::exp2(std::ceil(4.0 * std::log2(furthest)) / 4.0) : 1.0;
}

}  // namespace izb

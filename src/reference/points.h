// SPDX-License-Identifier: MIT
// Checks the receiver points themselves: rays from the same points cannot see an error in the points.
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "reference/embree.h"
#include "reference/truth.h"
#include "scene/scene.h"

namespace izb::reference {

/// The camera's rays in view space, affine in pixel coordinates, in double. Pixel (x, y), row 0 on top, has
/// the ray origin + x origin_dx + y origin_dy, direction + x direction_dx + y direction_dy through its
/// centre: a perspective camera varies the direction alone, an orthographic one the origin alone. Surfaces
/// count for t in [t_near, t_far].
struct PixelRays {
  int width_px = 0, height_px = 0;
  glm::dvec3 origin{0.0}, origin_dx{0.0}, origin_dy{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0}, direction_dx{0.0}, direction_dy{0.0};
  double t_near = 0.0, t_far = std::numeric_limits<double>::infinity();

  glm::dvec3 origin_at(double x, double y) const { return origin + x * origin_dx + y * origin_dy; }
  glm::dvec3 direction_at(double x, double y) const { return direction + x * direction_dx + y * direction_dy; }
};

/// The rays of a camera through the pixel centres, or beside them by its pixel shift. Directions have z = -1, so t is
/// the distance along the view axis and t_near and t_far are the camera's planes.
PixelRays pixel_rays(const Camera& camera, int width_px, int height_px);

/// What check_points found. checked = ok + near_edge + depth_tie + near_cutoff + wrong.
struct PointCheck {
  uint64_t checked = 0;
  uint64_t ok = 0;         ///< the pixel's triangle is the exact nearest hit that is there; a sky pixel hits nothing
  uint64_t near_edge = 0;  ///< the pixel's centre lies outside it or inside what is nearer, by at most 1/128 pixel
  uint64_t depth_tie = 0;  ///< something is nearer, but the depths are equal (8 ulps) somewhere within 1/128 pixel
  uint64_t near_cutoff =
      0;  ///< the alpha of its triangle, or of what is nearer, passes the cut-off within a ray's rounding
  uint64_t wrong = 0;
  std::vector<uint32_t> wrong_pixels;  ///< the first 100
  double max_plane_ulps = 0.0;         ///< largest distance of a receiver from its own triangle's plane, in float ulps
                                       ///< of the largest coordinate among the point and the triangle's corners
  uint32_t max_plane_pixel = 0;
  double max_ray_offset_px = 0.0;  ///< largest distance of a point, or of a micro-quad's centre, from its pixel's ray
  uint32_t max_ray_offset_pixel = 0;
  uint64_t lifted = 0;       ///< pixels whose micro-quad has another centre than their point
  double max_lift_px = 0.0;  ///< the furthest of them from its tangent plane, in pixel widths; infinite for one below
  uint32_t max_lift_pixel = 0;
};

/// Compares each pixel's point and triangle with the scene, in double; `tracer` (over the same triangles) only finds
/// what may be in front. All classes are checked: sky pixels must hit nothing, others their own triangle. Throws
/// izb::Error where the receivers are not one a pixel.
PointCheck check_points(const RayTracer& tracer, const Triangles& triangles, const PixelRays& rays,
                        const Receivers& receivers);

}  // namespace izb::reference

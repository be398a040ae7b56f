// SPDX-License-Identifier: MIT
#include "reference/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "reference/exact.h"
#include "reference/parallel.h"

namespace izb::reference {
namespace {

constexpr double tolerance_px = 1.0 / 128.0;
constexpr double tie_ulps = 8.0;
constexpr size_t wrong_cap = 100;
constexpr size_t pixels_per_pass = 1 << 18;

double float_ulp(double x) {
  return std::ldexp(1.0, std::ilogb(x) - 23);
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// View space to pixel coordinates, the inverse of PixelRays.
class Projection {
 public:
  explicit Projection(const PixelRays& rays)
      : origin_(rays.origin),
        perspective_(rays.direction_dx != glm::dvec3(0.0)),
        t_and_pixel_(glm::inverse(
            glm::dmat3(rays.direction, rays.direction_dx + rays.origin_dx, rays.direction_dy + rays.origin_dy))) {}

  // (x, y, t); for a perspective camera meaningful where t > 0.
  glm::dvec3 operator()(const glm::dvec3& p) const {
    const glm::dvec3 q = t_and_pixel_ * (p - origin_);
    return perspective_ ? glm::dvec3(q.y / q.x, q.z / q.x, q.x) : glm::dvec3(q.y, q.z, q.x);
  }
  bool in_front(const glm::dvec3& projected) const { return !perspective_ || projected.z > 0.0; }

 private:
  glm::dvec3 origin_;
  bool perspective_;
  glm::dmat3 t_and_pixel_;
};

double segment_distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 edge = b - a;
  const double squared = glm::dot(edge, edge);
  const double along = squared > 0.0 ? std::clamp(glm::dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return glm::length(a + along * edge - p);
}

// One triangle as the camera sees it.
class Seen {
 public:
  Seen(const Triangles& triangles, uint32_t triangle, const PixelRays& rays, const Projection& project) : rays_(rays) {
    const Corners t = corners(triangles, triangle);
    corner_ = {t.a, t.b, t.c};
    normal_ = glm::cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 p = project(corner_[i]);
      in_front_ = in_front_ && project.in_front(p);
      pixel_[i] = p;
    }
  }

  double t(double x, double y) const {
    return glm::dot(normal_, corner_[0] - rays_.origin_at(x, y)) / glm::dot(normal_, rays_.direction_at(x, y));
  }

  // Distance in pixels from a pixel's centre to the projected outline, positive inside.
  double inside_px(double x, double y) const {
    return in_front_ ? projected_inside_px({x, y}) : clipped_inside_px(x, y);
  }

 private:
  double projected_inside_px(const glm::dvec2& p) const {
    double distance = std::numeric_limits<double>::infinity();
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 a = pixel_[i], b = pixel_[(i + 1) % 3];
      distance = std::min(distance, segment_distance(p, a, b));
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      left += side > 0.0, right += side < 0.0;
    }
    return left && right ? -distance : distance;
  }

  // A corner lies behind the camera: the edges' lines instead. det(a-o, b-o, d) is affine in the pixel.
  double clipped_inside_px(double x, double y) const {
    const glm::dvec3 o = rays_.origin_at(x, y), d = rays_.direction_at(x, y);
    const double orientation = glm::dot(normal_, d) < 0.0 ? -1.0 : 1.0;
    double distance = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = corner_[i] - o, b = corner_[(i + 1) % 3] - o;
      const auto slope = [&](const glm::dvec3& o_step, const glm::dvec3& d_step) {
        return glm::dot(glm::cross(a, b), d_step) - glm::dot(glm::cross(o_step, b) + glm::cross(a, o_step), d);
      };
      const glm::dvec2 gradient(slope(rays_.origin_dx, rays_.direction_dx), slope(rays_.origin_dy, rays_.direction_dy));
      distance = std::min(distance, orientation * glm::dot(glm::cross(a, b), d) / glm::length(gradient));
    }
    return distance;
  }

  const PixelRays& rays_;
  std::array<glm::dvec3, 3> corner_;
  std::array<glm::dvec2, 3> pixel_;
  glm::dvec3 normal_;
  bool in_front_ = true;
};

// Whether the two depths are equal, up to rounding, at the pixel's centre or within 1/128 pixel of it.
bool depths_tie(const Seen& a, const Seen& b, double x, double y) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  constexpr double h = tolerance_px;
  for (const glm::dvec2 step :
       {glm::dvec2(0), glm::dvec2(h, 0), glm::dvec2(-h, 0), glm::dvec2(0, h), glm::dvec2(0, -h)}) {
    const double ta = a.t(x + step.x, y + step.y), difference = ta - b.t(x + step.x, y + step.y);
    if (std::abs(difference) <= tie_ulps * float_ulp(ta)) return true;
    least = std::min(least, difference), most = std::max(most, difference);
  }
  return least < 0.0 && most > 0.0;
}

enum class Outcome { ok, near_edge, depth_tie, wrong };

class PixelChecker {
 public:
  PixelChecker(const RayTracer& tracer, const Triangles& triangles, const PixelRays& rays)
      : tracer_(tracer), triangles_(triangles), rays_(rays), project_(rays) {}

  const Projection& projection() const { return project_; }

  Outcome check(uint32_t own, double x, double y) const {
    if (own >= triangles_.count()) return Outcome::wrong;
    const Seen mine = seen(own);
    const double inside = mine.inside_px(x, y), t = mine.t(x, y);
    if (!(inside >= -tolerance_px)) return Outcome::wrong;
    Outcome worst = inside >= 0.0 ? Outcome::ok : Outcome::near_edge;
    for (const uint32_t other : hits(x, y, std::isfinite(t) ? t * 1.001 : rays_.t_far)) {
      if (other == own) continue;
      const Seen theirs = seen(other);
      const double their_inside = theirs.inside_px(x, y), their_t = theirs.t(x, y);
      if (!(their_inside >= 0.0) || !(their_t < t) || !(their_t >= rays_.t_near)) continue;
      const bool at_edge = std::min(inside, their_inside) <= tolerance_px;
      const Outcome outcome = at_edge                          ? Outcome::near_edge
                              : depths_tie(theirs, mine, x, y) ? Outcome::depth_tie
                                                               : Outcome::wrong;
      worst = std::max(worst, outcome);
    }
    return worst;
  }

  Outcome check_sky(double x, double y) const {
    Outcome worst = Outcome::ok;
    for (const uint32_t other : hits(x, y, rays_.t_far)) {
      const Seen theirs = seen(other);
      const double inside = theirs.inside_px(x, y), t = theirs.t(x, y);
      if (!(inside >= 0.0) || !(t >= rays_.t_near) || !(t <= rays_.t_far)) continue;
      worst = std::max(worst, inside <= tolerance_px ? Outcome::near_edge : Outcome::wrong);
    }
    return worst;
  }

 private:
  Seen seen(uint32_t triangle) const { return {triangles_, triangle, rays_, project_}; }

  // Float rays miss only triangles whose outline is far closer than the tolerance.
  std::vector<uint32_t> hits(double x, double y, double t_far) const {
    return tracer_.all_hits(rays_.origin_at(x, y), rays_.direction_at(x, y),
                            static_cast<float>(rays_.t_near * (1.0 - 1e-5)),
                            static_cast<float>(std::min(t_far, rays_.t_far)));
  }

  const RayTracer& tracer_;
  const Triangles& triangles_;
  const PixelRays& rays_;
  Projection project_;
};

// Counts of one thread.
struct Partial {
  PointCheck sums;

  void count(Outcome outcome, uint32_t pixel) {
    ++sums.checked;
    switch (outcome) {
      case Outcome::ok:
        ++sums.ok;
        break;
      case Outcome::near_edge:
        ++sums.near_edge;
        break;
      case Outcome::depth_tie:
        ++sums.depth_tie;
        break;
      case Outcome::wrong:
        ++sums.wrong;
        sums.wrong_pixels.push_back(pixel);
        break;
    }
  }

  // A point that is not finite is infinitely far off.
  static void raise(double& maximum, uint32_t& at, double value, uint32_t pixel) {
    if (!std::isfinite(value)) value = std::numeric_limits<double>::infinity();
    if (value > maximum) maximum = value, at = pixel;
  }

  void measure(const Projection& project, const Triangles& triangles, const Receivers& receivers, uint32_t pixel,
               double x, double y) {
    const glm::dvec3 p(receivers.points_vs[pixel]);
    const glm::dvec3 on_screen = project(p);
    raise(sums.max_ray_offset_px, sums.max_ray_offset_pixel, glm::length(glm::dvec2(on_screen) - glm::dvec2(x, y)),
          pixel);
    // Points that get no light may stand beside their plane, e.g. on slivers seen edge-on.
    if (receivers.classes[pixel] != PixelClass::receiver || receivers.own_triangle[pixel] >= triangles.count()) return;
    const Corners own = corners(triangles, receivers.own_triangle[pixel]);
    const glm::dvec3 a(own.a), across = normal(own);
    const double size = std::max({largest(p), largest(a), largest(own.b), largest(own.c)});
    raise(sums.max_plane_ulps, sums.max_plane_pixel,
          std::abs(glm::dot(across, p - a)) / glm::length(across) / float_ulp(size), pixel);
  }

  void add(const Partial& other) {
    const PointCheck& o = other.sums;
    sums.checked += o.checked, sums.ok += o.ok, sums.near_edge += o.near_edge;
    sums.depth_tie += o.depth_tie, sums.wrong += o.wrong;
    sums.wrong_pixels.insert(sums.wrong_pixels.end(), o.wrong_pixels.begin(), o.wrong_pixels.end());
    if (o.max_plane_ulps > sums.max_plane_ulps)
      sums.max_plane_ulps = o.max_plane_ulps, sums.max_plane_pixel = o.max_plane_pixel;
    if (o.max_ray_offset_px > sums.max_ray_offset_px)
      sums.max_ray_offset_px = o.max_ray_offset_px, sums.max_ray_offset_pixel = o.max_ray_offset_pixel;
  }
};

}  // namespace

PixelRays pixel_rays(const Camera& camera, int width_px, int height_px) {
  PixelRays rays;
  rays.width_px = width_px, rays.height_px = height_px;
  rays.t_near = camera.near_plane, rays.t_far = camera.far_plane;
  const double half_height = camera.orthographic ? camera.ymag : std::tan(0.5 * camera.yfov_rad);
  const double step = 2.0 * half_height / height_px;  // pixels are square
  const glm::dvec3 first(0.5 * step * (1.0 - width_px), 0.5 * step * (height_px - 1.0), 0.0);
  const glm::dvec3 right(step, 0.0, 0.0), down(0.0, -step, 0.0);
  if (camera.orthographic) {
    rays.origin = first, rays.origin_dx = right, rays.origin_dy = down;
  } else {
    rays.direction += first, rays.direction_dx = right, rays.direction_dy = down;
  }
  return rays;
}

PointCheck check_points(const RayTracer& tracer, const Triangles& triangles, const PixelRays& rays,
                        const Receivers& receivers) {
  const size_t width = static_cast<size_t>(std::max(rays.width_px, 0));
  const size_t count = width * static_cast<size_t>(std::max(rays.height_px, 0));
  receivers.check("check the points");
  if (receivers.count() != count)
    fail("cannot check the points: {} x {} pixels come with {} points", rays.width_px, rays.height_px,
         receivers.count());
  const PixelChecker checker(tracer, triangles, rays);
  Partial total;
  std::mutex total_guard;
  std::vector<glm::vec3> origins, directions;
  for (size_t begin = 0; begin < count; begin += pixels_per_pass) {
    const size_t size = std::min(pixels_per_pass, count - begin);
    origins.resize(size), directions.resize(size);
    for (size_t k = 0; k < size; ++k) {
      const glm::dvec2 at((begin + k) % width, (begin + k) / width);
      origins[k] = rays.origin_at(at.x, at.y), directions[k] = rays.direction_at(at.x, at.y);
    }
    const PrimaryHits nearest =
        tracer.primary_hits(origins, directions, static_cast<float>(rays.t_near), static_cast<float>(rays.t_far));
    parallel_for(size, 4096, 0, [&](size_t first, size_t end, unsigned) {
      Partial part;
      for (size_t k = first; k < end; ++k) {
        const uint32_t pixel = static_cast<uint32_t>(begin + k), own = receivers.own_triangle[pixel];
        const double x = static_cast<double>(pixel % width), y = static_cast<double>(pixel / width);
        const uint32_t hit = nearest.triangle[k];
        if (receivers.classes[pixel] == PixelClass::sky) {
          part.count(hit == no_triangle ? Outcome::ok : checker.check_sky(x, y), pixel);
          continue;
        }
        part.count(hit == own && own != no_triangle ? Outcome::ok : checker.check(own, x, y), pixel);
        part.measure(checker.projection(), triangles, receivers, pixel, x, y);
      }
      const std::scoped_lock lock(total_guard);
      total.add(part);
    });
  }
  std::sort(total.sums.wrong_pixels.begin(), total.sums.wrong_pixels.end());
  if (total.sums.wrong_pixels.size() > wrong_cap) total.sums.wrong_pixels.resize(wrong_cap);
  return total.sums;
}

}  // namespace izb::reference

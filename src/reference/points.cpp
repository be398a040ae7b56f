// SPDX-License-Identifier: MIT
#include "reference/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>

#include "base/error.h"
#include "reference/exact.h"
#include "reference/parallel.h"

namespace izb::reference {
namespace {

constexpr double tolerance_px = 1.0 / 128.0;
constexpr double tie_ulps = 8.0;
constexpr size_t wrong_cap = 100;
constexpr size_t pixels_per_chunk = 4096;
// By how much the float ray may misjudge how far a triangle is.
constexpr double ray_slack = 1.001;

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
  Seen(const Triangles& triangles, uint32_t triangle, const PixelRays& rays, const Projection& project)
      : rays_(rays), cutouts_(triangles.cutouts.get()), triangle_(triangle), corners_(corners(triangles, triangle)) {
    corner_ = {corners_.a, corners_.b, corners_.c};
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

  // By the alpha where the pixel's ray meets it. No rasteriser has a part in that place: what may move it are the ray's
  // floats.
  Presence presence(double x, double y) const {
    if (!cutouts_) return {};
    const double pixel = glm::length(rays_.origin_dx) + std::abs(t(x, y)) * glm::length(rays_.direction_dx);
    const double ray_error_px = 4.0 * 0x1p-24 * std::max(rays_.width_px, rays_.height_px);
    return cutouts_->within(triangle_, corners_,
                            {rays_.origin_at(x, y), rays_.direction_at(x, y), ray_error_px * pixel,
                             ray_error_px * glm::length(rays_.direction_dx)});
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
  const Cutouts* cutouts_;
  uint32_t triangle_;
  Corners corners_;
  std::array<glm::dvec3, 3> corner_;
  std::array<glm::dvec2, 3> pixel_;
  glm::dvec3 normal_;
  bool in_front_ = true;
};

// A pixel's centre and what lies within 1/128 pixel of it.
const std::array<glm::dvec2, 5> steps_px{glm::dvec2(0), glm::dvec2(tolerance_px, 0), glm::dvec2(-tolerance_px, 0),
                                         glm::dvec2(0, tolerance_px), glm::dvec2(0, -tolerance_px)};

// Whether the two depths are equal, up to rounding, at the pixel's centre or within 1/128 pixel of it.
bool depths_tie(const Seen& a, const Seen& b, double x, double y) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const glm::dvec2& step : steps_px) {
    const double ta = a.t(x + step.x, y + step.y), difference = ta - b.t(x + step.x, y + step.y);
    if (std::abs(difference) <= tie_ulps * float_ulp(ta)) return true;
    least = std::min(least, difference), most = std::max(most, difference);
  }
  return least < 0.0 && most > 0.0;
}

enum class Outcome { ok, near_edge, depth_tie, near_cutoff, wrong };

class PixelChecker {
 public:
  PixelChecker(const Triangles& triangles, const PixelRays& rays)
      : triangles_(triangles), rays_(rays), project_(rays) {}

  const Projection& projection() const { return project_; }

  // Up to where something may be in front of a pixel's own triangle.
  float ray_end(uint32_t own, double x, double y) const {
    const double t = own < triangles_.count() ? seen(own).t(x, y) : rays_.t_far;
    return static_cast<float>(std::min(t > 0.0 ? ray_slack * t : rays_.t_far, rays_.t_far));
  }

  Outcome check(uint32_t own, double x, double y, std::span<const uint32_t> candidates) const {
    if (own >= triangles_.count()) return Outcome::wrong;
    const Seen mine = seen(own);
    const double inside = mine.inside_px(x, y);
    if (!(inside >= -tolerance_px) || !in_range(mine, x, y)) return Outcome::wrong;
    const Presence presence = mine.presence(x, y);
    if (!presence.there && presence.sure) return Outcome::wrong;
    Outcome worst = !presence.sure ? Outcome::near_cutoff : inside >= 0.0 ? Outcome::ok : Outcome::near_edge;
    for (const uint32_t other : candidates)
      if (other != own) worst = std::max(worst, behind(mine, seen(other), x, y));
    return worst;
  }

  Outcome check_sky(double x, double y, std::span<const uint32_t> candidates) const {
    Outcome worst = Outcome::ok;
    for (const uint32_t other : candidates) {
      const Seen theirs = seen(other);
      const double inside = theirs.inside_px(x, y), t = theirs.t(x, y);
      if (!(inside >= 0.0) || !(t >= rays_.t_near) || !(t <= rays_.t_far)) continue;
      const Presence presence = theirs.presence(x, y);
      if (!presence.there && presence.sure) continue;
      worst = std::max(worst, inside <= tolerance_px ? Outcome::near_edge
                              : presence.sure        ? Outcome::wrong
                                                     : Outcome::near_cutoff);
    }
    return worst;
  }

 private:
  Seen seen(uint32_t triangle) const { return {triangles_, triangle, rays_, project_}; }

  // What it is that the pixel shows `mine`, given `theirs`. Only an edge of `theirs` can be why it is not in front: one
  // of `mine`, which rasterisers may move, too, does not lift it.
  Outcome behind(const Seen& mine, const Seen& theirs, double x, double y) const {
    const double inside = theirs.inside_px(x, y), t = theirs.t(x, y);
    if (!(inside >= 0.0) || !(t < mine.t(x, y)) || !(t >= rays_.t_near)) return Outcome::ok;
    const Presence presence = theirs.presence(x, y);
    if (!presence.there && presence.sure) return Outcome::ok;
    if (inside <= tolerance_px) return Outcome::near_edge;
    if (depths_tie(theirs, mine, x, y)) return Outcome::depth_tie;
    return presence.sure ? Outcome::wrong : Outcome::near_cutoff;
  }

  // Whether the camera's planes cut the triangle off neither here nor within 1/128 pixel.
  bool in_range(const Seen& mine, double x, double y) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const glm::dvec2& step : steps_px) {
      const double t = mine.t(x + step.x, y + step.y);
      least = std::min(least, t), most = std::max(most, t);
    }
    return most >= rays_.t_near * (1.0 - 1e-6) && least <= rays_.t_far * (1.0 + 1e-6);
  }

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
      case Outcome::near_cutoff:
        ++sums.near_cutoff;
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
    const glm::dvec3 center(receivers.center(pixel));
    for (const glm::dvec3& seen : {p, center})
      raise(sums.max_ray_offset_px, sums.max_ray_offset_pixel,
            glm::length(glm::dvec2(project(seen)) - glm::dvec2(x, y)), pixel);
    // Points that get no light may stand beside their plane, e.g. on slivers seen edge-on.
    if (receivers.classes[pixel] != PixelClass::receiver || receivers.own_triangle[pixel] >= triangles.count()) return;
    const Corners own = corners(triangles, receivers.own_triangle[pixel]);
    const glm::dvec3 a(own.a), across = normal(own);
    const double size = std::max({largest(p), largest(a), largest(own.b), largest(own.c)});
    raise(sums.max_plane_ulps, sums.max_plane_pixel,
          std::abs(glm::dot(across, p - a)) / glm::length(across) / float_ulp(size), pixel);
    if (center == p) return;
    ++sums.lifted;
    const bool perspective = receivers.camera.perspective;
    const double viewer = perspective ? -glm::dot(across, p) : across.z;
    const double height = glm::dot(across, center - p) / glm::length(across) * (viewer < 0.0 ? -1.0 : 1.0);
    const double width = receivers.camera.step.x * (perspective ? -p.z : 1.0);
    raise(sums.max_lift_px, sums.max_lift_pixel,
          height >= 0.0 ? height / width : std::numeric_limits<double>::infinity(), pixel);
  }

  void add(const Partial& other) {
    const PointCheck& o = other.sums;
    sums.checked += o.checked, sums.ok += o.ok, sums.near_edge += o.near_edge;
    sums.depth_tie += o.depth_tie, sums.near_cutoff += o.near_cutoff, sums.wrong += o.wrong;
    sums.wrong_pixels.insert(sums.wrong_pixels.end(), o.wrong_pixels.begin(), o.wrong_pixels.end());
    if (o.max_plane_ulps > sums.max_plane_ulps)
      sums.max_plane_ulps = o.max_plane_ulps, sums.max_plane_pixel = o.max_plane_pixel;
    if (o.max_ray_offset_px > sums.max_ray_offset_px)
      sums.max_ray_offset_px = o.max_ray_offset_px, sums.max_ray_offset_pixel = o.max_ray_offset_pixel;
    sums.lifted += o.lifted;
    if (o.max_lift_px > sums.max_lift_px) sums.max_lift_px = o.max_lift_px, sums.max_lift_pixel = o.max_lift_pixel;
  }
};

}  // namespace

PixelRays pixel_rays(const Camera& camera, int width_px, int height_px) {
  PixelRays rays;
  rays.width_px = width_px, rays.height_px = height_px;
  rays.t_near = camera.near_plane, rays.t_far = camera.far_plane;
  const double half_height = camera.orthographic ? camera.ymag : std::tan(0.5 * camera.yfov_rad);
  const double step = 2.0 * half_height / height_px;  // pixels are square
  const glm::dvec2 shift = camera.pixel_shift;
  const glm::dvec3 first(step * (0.5 * (1.0 - width_px) + shift.x), step * (0.5 * (height_px - 1.0) + shift.y), 0.0);
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
  const PixelChecker checker(triangles, rays);
  Partial total;
  std::mutex total_guard;
  parallel_for(count, pixels_per_chunk, 0, [&](size_t begin, size_t end, unsigned) {
    const auto at = [&](size_t pixel) { return glm::dvec2(pixel % width, pixel / width); };
    const auto own_of = [&](size_t pixel) {
      return receivers.classes[pixel] == PixelClass::sky ? no_triangle : receivers.own_triangle[pixel];
    };
    std::vector<glm::vec3> origins, directions;
    std::vector<float> ends;
    for (size_t pixel = begin; pixel < end; ++pixel) {
      const glm::dvec2 p = at(pixel);
      origins.emplace_back(rays.origin_at(p.x, p.y)), directions.emplace_back(rays.direction_at(p.x, p.y));
      ends.push_back(checker.ray_end(own_of(pixel), p.x, p.y));
    }
    const AllHits hits = tracer.all_hits(origins, directions, static_cast<float>(rays.t_near * (1.0 - 1e-5)), ends);
    Partial part;
    std::vector<uint32_t> candidates;
    for (size_t pixel = begin; pixel < end; ++pixel) {
      const glm::dvec2 p = at(pixel);
      const std::span<const uint32_t> found = hits.of(pixel - begin);
      candidates.assign(found.begin(), found.end());
      // A float ray may miss a triangle whose corners are far away or behind the camera by more than the tolerance.
      // Such a one is large in the picture: a neighbour shows it.
      const auto add = [&](bool there, size_t neighbour) {
        if (there && own_of(neighbour) < triangles.count()) candidates.push_back(own_of(neighbour));
      };
      add(pixel % width > 0, pixel - 1), add(pixel % width + 1 < width, pixel + 1);
      add(pixel >= width, pixel - width), add(pixel + width < count, pixel + width);
      const uint32_t id = static_cast<uint32_t>(pixel);
      if (receivers.classes[pixel] == PixelClass::sky) {
        part.count(checker.check_sky(p.x, p.y, candidates), id);
        continue;
      }
      part.count(checker.check(receivers.own_triangle[pixel], p.x, p.y, candidates), id);
      part.measure(checker.projection(), triangles, receivers, id, p.x, p.y);
    }
    const std::scoped_lock lock(total_guard);
    total.add(part);
  });
  std::sort(total.sums.wrong_pixels.begin(), total.sums.wrong_pixels.end());
  if (total.sums.wrong_pixels.size() > wrong_cap) total.sums.wrong_pixels.resize(wrong_cap);
  return total.sums;
}

}  // namespace izb::reference

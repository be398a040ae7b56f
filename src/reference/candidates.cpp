// SPDX-License-Identifier: MIT
#include "reference/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/parallel.h"

namespace izb::reference {
namespace {

constexpr size_t triangles_per_chunk = 8192;
// A cube face's pyramid reaches further than 45 degrees, by the balls' size.
constexpr double pyramid_slope = 1.1;
// Balls whose centre is within this many radii of the light's plane do without the grid.
constexpr double nearest_ball = 20.0;
// Slack relative to the coordinates involved: a few thousand ulps of double.
constexpr double rounding = 1e-12;

// A way to look at the scene from the light: orthographic, or one face of the cube around a positional light.
struct View {
  glm::dvec3 origin{0.0}, u, v, w;  // w points away from the light
  bool perspective = false;
  glm::dvec3 transform(const glm::dvec3& p) const {
    const glm::dvec3 q = p - origin;
    return {glm::dot(u, q), glm::dot(v, q), glm::dot(w, q)};
  }
};

std::vector<View> views_of(const LightPoint& light) {
  if (light.positional) {
    std::vector<View> views;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) {
        View view;
        view.origin = light.xyz_vs;
        view.perspective = true;
        view.w = view.u = view.v = glm::dvec3(0.0);
        view.w[axis] = sign, view.u[(axis + 1) % 3] = 1.0, view.v[(axis + 2) % 3] = 1.0;
        views.push_back(view);
      }
    return views;
  }
  View view;
  view.w = -glm::normalize(glm::dvec3(light.xyz_vs));
  const glm::dvec3 a = glm::abs(view.w);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  view.u = glm::normalize(glm::cross(view.w, axis));
  view.v = glm::cross(view.w, view.u);
  return {view};
}

// A disc on the view's plane that contains the ball's projection (per axis).
struct Disc {
  glm::dvec2 center;
  double radius;
  double furthest;  // depth of the ball's far end
  uint32_t ball;
};

struct Grid {
  glm::dvec2 min{0.0}, max{0.0}, cells_per_unit{0.0};
  int columns = 0, rows = 0;
  double largest_radius = 0.0, furthest = 0.0;
  std::vector<uint32_t> first;
  std::vector<Disc> discs;

  int column(double x) const {
    return static_cast<int>(std::clamp((x - min.x) * cells_per_unit.x, 0.0, columns - 1.0));
  }
  int row(double y) const { return static_cast<int>(std::clamp((y - min.y) * cells_per_unit.y, 0.0, rows - 1.0)); }

  explicit Grid(const std::vector<Disc>& unsorted) {
    if (unsorted.empty()) return;
    min = max = unsorted[0].center;
    for (const Disc& disc : unsorted) {
      min = glm::min(min, disc.center), max = glm::max(max, disc.center);
      largest_radius = std::max(largest_radius, disc.radius);
      furthest = std::max(furthest, disc.furthest);
    }
    columns = rows = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(unsorted.size()))), 1, 1024);
    const glm::dvec2 extent = glm::max(max - min, glm::dvec2(std::numeric_limits<double>::min()));
    cells_per_unit = glm::dvec2(columns, rows) / extent;
    for (int i = 0; i < 2; ++i)
      if (!std::isfinite(cells_per_unit[i])) cells_per_unit[i] = 0.0;
    const auto cell = [&](const Disc& disc) {
      return static_cast<size_t>(row(disc.center.y)) * static_cast<size_t>(columns) +
             static_cast<size_t>(column(disc.center.x));
    };
    first.assign(static_cast<size_t>(columns) * static_cast<size_t>(rows) + 1, 0);
    for (const Disc& disc : unsorted) ++first[cell(disc) + 1];
    for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    discs.resize(unsorted.size());
    for (const Disc& disc : unsorted) discs[next[cell(disc)]++] = disc;
  }
};

// A triangle as the view sees it, if it does: a box on its plane and the depth nearest to the light.
struct Footprint {
  glm::dvec2 min, max;
  double nearest;
  bool visible;
};

Footprint orthographic_footprint(const std::array<glm::dvec3, 3>& corner) {
  Footprint box{glm::dvec2(corner[0]), glm::dvec2(corner[0]), corner[0].z, true};
  double size = 0.0;
  for (const glm::dvec3& p : corner) {
    box.min = glm::min(box.min, glm::dvec2(p)), box.max = glm::max(box.max, glm::dvec2(p));
    box.nearest = std::min(box.nearest, p.z);
    size = std::max(size, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
  }
  box.min -= rounding * size, box.max += rounding * size, box.nearest -= rounding * size;
  return box;
}

// Clips to the pyramid |x| <= slope z, |y| <= slope z, whose four planes meet in the light.
Footprint perspective_footprint(const std::array<glm::dvec3, 3>& corner) {
  std::array<glm::dvec3, 8> polygon{corner[0], corner[1], corner[2]}, clipped;
  size_t size = 3;
  double reach = 0.0;
  for (const glm::dvec3& p : corner) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  constexpr double s = pyramid_slope;
  for (const glm::dvec3& plane :
       {glm::dvec3(1, 0, s), glm::dvec3(-1, 0, s), glm::dvec3(0, 1, s), glm::dvec3(0, -1, s)}) {
    size_t kept = 0;
    for (size_t i = 0; i < size; ++i) {
      const glm::dvec3 &p = polygon[i], &q = polygon[(i + 1) % size];
      const double dp = glm::dot(plane, p), dq = glm::dot(plane, q);
      if (dp >= 0.0) clipped[kept++] = p;
      if ((dp >= 0.0) != (dq >= 0.0)) clipped[kept++] = p + (q - p) * (dp / (dp - dq));
    }
    if (kept == 0) return {{}, {}, 0.0, false};
    size = kept;
    polygon = clipped;
  }
  Footprint box{glm::dvec2(std::numeric_limits<double>::infinity()),
                glm::dvec2(-std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity(), true};
  for (size_t i = 0; i < size; ++i) box.nearest = std::min(box.nearest, polygon[i].z);
  if (!(box.nearest > 1e-6 * reach)) return {glm::dvec2(-2.0), glm::dvec2(2.0), 0.0, true};  // reaches the light
  for (size_t i = 0; i < size; ++i) {
    const glm::dvec2 p = glm::dvec2(polygon[i]) / polygon[i].z;
    box.min = glm::min(box.min, p), box.max = glm::max(box.max, p);
  }
  const double slack = rounding * (1.0 + reach / box.nearest);
  box.min -= slack, box.max += slack, box.nearest -= rounding * reach;
  return box;
}

// The three planes through the light and an edge, normals inwards: an occluded point is on the inner side of
// all. A plane whose direction or orientation rounding leaves open is left out: that lets more points in.
class ShadowPlanes {
 public:
  ShadowPlanes(const std::array<glm::dvec3, 3>& corner, const LightPoint& light) {
    const glm::dvec3 q(light.xyz_vs);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 &from = corner[i], &to = corner[(i + 1) % 3], &opposite = corner[(i + 2) % 3];
      const glm::dvec3 edge = to - from, ray = light.positional ? from - q : q;
      const glm::dvec3 normal = glm::cross(ray, edge);
      const double length = glm::length(normal), height = glm::dot(normal, opposite - from);
      if (!(length > 1e-5 * glm::length(ray) * glm::length(edge)) ||
          !(std::abs(height) > 1e-9 * length * glm::length(opposite - from)))
        continue;
      planes_[count_++] = {normal * ((height > 0.0 ? 1.0 : -1.0) / length), from};
    }
  }

  bool may_touch(const glm::dvec3& center, double radius) const {
    for (int i = 0; i < count_; ++i) {
      const glm::dvec3 offset = center - planes_[i].point;
      const double slack = 1e-3 * radius + 1e-10 * (std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z));
      if (glm::dot(planes_[i].normal, offset) < -(radius + slack)) return false;
    }
    return true;
  }

 private:
  struct Plane {
    glm::dvec3 normal, point;
  };
  std::array<Plane, 3> planes_;
  int count_ = 0;
};

struct Pair {
  uint32_t ball, triangle;
};

Candidates gather(size_t balls, const std::vector<std::vector<Pair>>& found) {
  Candidates result;
  result.first.assign(balls + 1, 0);
  for (const auto& pairs : found)
    for (const Pair& pair : pairs) ++result.first[pair.ball + 1];
  for (size_t i = 1; i <= balls; ++i) result.first[i] += result.first[i - 1];
  result.triangles.resize(result.first[balls]);
  std::vector<size_t> next(result.first.begin(), result.first.end() - 1);
  for (const auto& pairs : found)
    for (const Pair& pair : pairs) result.triangles[next[pair.ball]++] = pair.triangle;
  for (size_t i = 0; i < balls; ++i)
    std::sort(result.triangles.begin() + static_cast<std::ptrdiff_t>(result.first[i]),
              result.triangles.begin() + static_cast<std::ptrdiff_t>(result.first[i + 1]));
  return result;
}

}  // namespace

Candidates find_candidates(const Triangles& triangles, const LightPoint& light, std::span<const Ball> balls) {
  const std::vector<View> views = views_of(light);
  std::vector<std::vector<Disc>> discs(views.size());
  std::vector<uint32_t> ungridded;
  for (uint32_t i = 0; i < balls.size(); ++i) {
    const double radius = 1.001 * balls[i].radius;
    if (!light.positional) {
      const glm::dvec3 p = views[0].transform(balls[i].center_vs);
      const double slack = rounding * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
      discs[0].push_back({glm::dvec2(p), radius + slack, p.z + radius + slack, i});
      continue;
    }
    size_t face = 0;
    for (size_t f = 1; f < views.size(); ++f)
      if (views[f].transform(balls[i].center_vs).z > views[face].transform(balls[i].center_vs).z) face = f;
    const glm::dvec3 p = views[face].transform(balls[i].center_vs);
    if (p.z <= nearest_ball * radius) {
      ungridded.push_back(i);
      continue;
    }
    // For a point (x', z') of the ball, |x'/z' - x/z| <= radius |(1, x/z)| / z', |x/z| <= 1, z' >= z -
    // radius.
    discs[face].push_back({glm::dvec2(p) / p.z, 1.5 * radius / (p.z - radius) + rounding, p.z + radius, i});
  }
  std::vector<Grid> grids;
  for (const auto& list : discs) grids.emplace_back(list);

  std::vector<std::vector<Pair>> found(thread_count(0));
  parallel_for(triangles.count(), triangles_per_chunk, 0, [&](size_t begin, size_t end, unsigned thread) {
    std::vector<Pair>& pairs = found[thread];
    for (size_t t = begin; t < end; ++t) {
      const std::array<glm::dvec3, 3> corner{triangles.positions_vs[3 * t], triangles.positions_vs[3 * t + 1],
                                             triangles.positions_vs[3 * t + 2]};
      std::optional<ShadowPlanes> planes;
      const auto consider = [&](uint32_t i) {
        if (balls[i].spared == t) return;
        if (!planes) planes.emplace(corner, light);
        if (planes->may_touch(balls[i].center_vs, balls[i].radius)) pairs.push_back({i, static_cast<uint32_t>(t)});
      };
      for (const uint32_t i : ungridded) consider(i);
      for (size_t f = 0; f < views.size(); ++f) {
        const Grid& grid = grids[f];
        if (grid.discs.empty()) continue;
        const std::array<glm::dvec3, 3> seen{views[f].transform(corner[0]), views[f].transform(corner[1]),
                                             views[f].transform(corner[2])};
        const Footprint box = views[f].perspective ? perspective_footprint(seen) : orthographic_footprint(seen);
        const double r = grid.largest_radius;
        if (!box.visible || box.nearest > grid.furthest || box.max.x < grid.min.x - r || box.max.y < grid.min.y - r ||
            box.min.x > grid.max.x + r || box.min.y > grid.max.y + r)
          continue;
        const int left = grid.column(box.min.x - r), right = grid.column(box.max.x + r);
        const int bottom = grid.row(box.min.y - r), top = grid.row(box.max.y + r);
        for (int y = bottom; y <= top; ++y) {
          const size_t row = static_cast<size_t>(y) * static_cast<size_t>(grid.columns);
          for (uint32_t k = grid.first[row + static_cast<size_t>(left)];
               k < grid.first[row + static_cast<size_t>(right) + 1]; ++k) {
            const Disc& disc = grid.discs[k];
            if (disc.center.x + disc.radius < box.min.x || disc.center.x - disc.radius > box.max.x ||
                disc.center.y + disc.radius < box.min.y || disc.center.y - disc.radius > box.max.y ||
                disc.furthest < box.nearest)
              continue;
            consider(disc.ball);
          }
        }
      }
    }
  });
  return gather(balls.size(), found);
}

}  // namespace izb::reference

// SPDX-License-Identifier: MIT
#include "reference/witness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace izb::reference {
namespace {

constexpr size_t crossing_lines = 32;
constexpr double inside_band = 0.999;  // keeps witnesses within the band whatever double rounds

// The plane through the point, perpendicular to the light's direction.
struct Frame {
  glm::dvec3 point, to_light, u, v;  // to_light is not unit length; u and v are

  Frame(const glm::dvec3& p, const LightPoint& light)
      : point(p), to_light(light.positional ? glm::dvec3(light.xyz_vs) - p : glm::dvec3(light.xyz_vs)) {
    const glm::dvec3 w = glm::normalize(to_light), a = glm::abs(w);
    const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                            : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
    u = glm::normalize(glm::cross(w, axis));
    v = glm::cross(w, u);
  }
  glm::dvec3 at(const glm::dvec2& x) const { return point + x.x * u + x.y * v; }
};

// All x of the frame's plane with dot(normal, x) = offset; normal has unit length.
struct Line {
  glm::dvec2 normal;
  double offset;
  bool operator==(const Line&) const = default;
};

void add_line(std::vector<Line>& lines, const Frame& frame, const glm::dvec3& normal, double offset, double band) {
  const glm::dvec2 n(glm::dot(normal, frame.u), glm::dot(normal, frame.v));
  const double length = glm::length(n);
  if (length > 0.0 && std::abs(offset) <= band * length) lines.push_back({n / length, offset / length});
}

bool before(const glm::vec3& p, const glm::vec3& q) {
  return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
}

// The shadow edge of (p, q).
void add_edge(std::vector<Line>& lines, const Frame& frame, const LightPoint& light, glm::vec3 p, glm::vec3 q,
              double band) {
  if (before(q, p)) std::swap(p, q);  // triangles that share an edge then give one and the same line
  const glm::dvec3 from = glm::dvec3(p) - frame.point, edge = glm::dvec3(q) - glm::dvec3(p);
  const glm::dvec3 ray = light.positional ? glm::dvec3(p) - glm::dvec3(light.xyz_vs) : frame.to_light;
  const glm::dvec3 normal = glm::cross(ray, edge);
  add_line(lines, frame, normal, glm::dot(normal, from), band);
}

// Where the triangle's own plane meets the frame's: its shadow ends there, too.
void add_plane(std::vector<Line>& lines, const Frame& frame, const Corners& t, double band) {
  const glm::dvec3 across = normal(t);
  add_line(lines, frame, across, glm::dot(across, glm::dvec3(t.a) - frame.point), band);
}

// The nearest lines first, each once.
void sort_lines(std::vector<Line>& lines) {
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tuple(std::abs(a.offset), a.offset, a.normal.x, a.normal.y) <
           std::tuple(std::abs(b.offset), b.offset, b.normal.x, b.normal.y);
  });
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
}

// Calls differs(x) with one point of each cell that the lines cut the disc into, until it returns true.
template <typename Differs>
bool search_disc(const std::vector<Line>& lines, double band, Differs&& differs) {
  const double radius = inside_band * band;
  const auto inside = [&](const glm::dvec2& x) { return glm::dot(x, x) <= radius * radius && differs(x); };
  constexpr double steps[] = {1e-2, 1e-4, 1e-6};  // of the band: how far beyond a line or a crossing

  for (const Line& line : lines)
    for (const double step : steps)
      for (const double sign : {1.0, -1.0})
        if (inside(line.normal * (line.offset + sign * step * band))) return true;

  std::vector<double> angles;
  for (const Line& line : lines) {
    const double cosine = line.offset / radius;
    if (std::abs(cosine) > 1.0) continue;
    const double center = std::atan2(line.normal.y, line.normal.x), half = std::acos(cosine);
    for (double angle : {center - half, center + half})
      angles.push_back(angle - 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi)));
  }
  if (angles.empty()) angles.push_back(0.0);
  std::sort(angles.begin(), angles.end());
  for (size_t i = 0; i < angles.size(); ++i) {
    const double end = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * std::numbers::pi;
    const double middle = 0.5 * (angles[i] + end);
    if (differs(radius * glm::dvec2(std::cos(middle), std::sin(middle)))) return true;
  }

  const size_t count = std::min(lines.size(), crossing_lines);
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < i; ++j) {
      const Line &a = lines[i], &b = lines[j];
      const double det = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
      if (std::abs(det) < 1e-9) continue;
      const auto solve = [&](double da, double db) {
        return glm::dvec2(da * b.normal.y - db * a.normal.y, db * a.normal.x - da * b.normal.x) / det;
      };
      const glm::dvec2 crossing = solve(a.offset, b.offset);
      if (glm::dot(crossing, crossing) > band * band) continue;
      for (const double step : steps)
        for (const double sa : {step, -step})
          for (const double sb : {step, -step})
            if (inside(crossing + solve(sa * band, sb * band))) return true;
    }
  return false;
}

// A triangle's plane close over the point: unit normal towards the light, height over the point.
struct Lid {
  glm::dvec3 normal;
  double height;
};

// Where several planes are close, as under a fold, the point is lit above all of them: tries the shortest moves to just
// above each two and each three of the nearest.
template <typename Differs>
bool lit_above(std::vector<Lid>& lids, double band, Differs&& differs) {
  std::sort(lids.begin(), lids.end(),
            [](const Lid& a, const Lid& b) { return std::abs(a.height) < std::abs(b.height); });
  const size_t count = std::min<size_t>(lids.size(), 12);
  const auto tries = [&](const glm::dvec3& move) { return glm::length(move) <= inside_band * band && differs(move); };
  for (const double above : {1e-3, 0.1})
    for (size_t i = 0; i < count; ++i)
      for (size_t j = 0; j < i; ++j) {
        const glm::dvec3 &m = lids[i].normal, &n = lids[j].normal;
        const double hm = lids[i].height + above * band, hn = lids[j].height + above * band;
        const double mn = glm::dot(m, n), det = 1.0 - mn * mn;
        if (det < 1e-9) continue;
        if (tries(m * ((hm - hn * mn) / det) + n * ((hn - hm * mn) / det))) return true;
        for (size_t k = 0; k < j; ++k) {
          const glm::dmat3 rows = glm::transpose(glm::dmat3(m, n, lids[k].normal));
          if (std::abs(glm::determinant(rows)) < 1e-6) continue;
          if (tries(glm::inverse(rows) * glm::dvec3(hm, hn, lids[k].height + above * band))) return true;
        }
      }
  return false;
}

}  // namespace

bool shadowed_exact(const glm::dvec3& point_vs, std::span<const Corners> occluders, const LightPoint& light) {
  return std::any_of(occluders.begin(), occluders.end(),
                     [&](const Corners& t) { return occluded_exact(point_vs, t, light); });
}

bool truth_changes_within(const glm::dvec3& point_vs, double band, bool truth, std::span<const Corners> occluders,
                          const LightPoint& light) {
  const Frame frame(point_vs, light);
  std::vector<Corners> usable(occluders.begin(), occluders.end());
  if (!truth) std::erase_if(usable, [&](const Corners& t) { return !plane_between_exact(point_vs, t, light); });

  std::vector<Line> lines;
  for (const Corners& t : usable) {
    add_edge(lines, frame, light, t.a, t.b, band);
    add_edge(lines, frame, light, t.b, t.c, band);
    add_edge(lines, frame, light, t.c, t.a, band);
    add_plane(lines, frame, t, band);
  }
  sort_lines(lines);
  const auto differs = [&](const glm::dvec3& q) { return shadowed_exact(q, usable, light) != truth; };
  if (search_disc(lines, band, [&](const glm::dvec2& x) { return differs(frame.at(x)); })) return true;
  if (!truth) return false;

  // A leak may lie in the bias of a plane: the point is lit a little further up.
  const auto lit_along = [&](const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0)) return false;
    for (const double r : {0.01, 0.1, 0.5, inside_band})
      if (differs(point_vs + direction * (r * band / length))) return true;
    return false;
  };
  if (lit_along(frame.to_light)) return true;
  std::vector<Lid> lids;
  for (const Corners& t : usable) {
    const glm::dvec3 a(t.a), normal = glm::cross(glm::dvec3(t.b) - a, glm::dvec3(t.c) - a);
    const double length = glm::length(normal), height = glm::dot(normal, a - point_vs) / length;
    // A triangle far from the point shadows it with its edges, not with its plane.
    if (!(std::abs(height) <= band)) continue;
    if (lit_along(normal) || lit_along(-normal)) return true;
    const double side = glm::dot(normal, frame.to_light) < 0.0 ? -1.0 : 1.0;
    lids.push_back({normal * (side / length), height * side});
  }
  return lit_above(lids, band, [&](const glm::dvec3& move) { return differs(point_vs + move); });
}

double nearest_edge_distance(const glm::dvec3& point_vs, std::span<const Corners> occluders, const LightPoint& light) {
  const Frame frame(point_vs, light);
  const double range = glm::length(frame.to_light);
  const auto project = [&](const glm::vec3& p, glm::dvec2& x) {
    glm::dvec3 q = glm::dvec3(p) - point_vs;
    if (light.positional) {
      const glm::dvec3 ray = q - frame.to_light;  // from the light
      const double depth = -glm::dot(ray, frame.to_light) / range;
      if (!(depth > 0.0)) return false;  // beside or behind the light: casts no such edge
      q = frame.to_light + ray * (range / depth);
    }
    x = {glm::dot(q, frame.u), glm::dot(q, frame.v)};
    return true;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const Corners& t : occluders) {
    const glm::vec3 corner[3] = {t.a, t.b, t.c};
    for (int i = 0; i < 3; ++i) {
      glm::dvec2 from, to;
      if (!project(corner[i], from) || !project(corner[(i + 1) % 3], to)) continue;
      const glm::dvec2 edge = to - from;
      const double squared = glm::dot(edge, edge);
      const double along = squared > 0.0 ? std::clamp(-glm::dot(from, edge) / squared, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, glm::length(from + along * edge));
    }
  }
  return nearest;
}

}  // namespace izb::reference

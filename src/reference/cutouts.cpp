// SPDX-License-Identifier: MIT
#include "reference/cutouts.h"

#include <algorithm>
#include <cmath>

#include "reference/exact.h"

namespace izb::reference {
namespace {

// A mask may round texels' sums and the cut-off to floats: 2^-24 each, some five times.
constexpr double alpha_rounding = 1e-6;
// Slack for the doubles here: some thousand ulps.
constexpr double texel_rounding = 1e-13;
// A wider neighbourhood is not searched: nothing is sure there.
constexpr int64_t widest = 64;
constexpr double furthest_texel = 1e9;

int64_t wrapped(int64_t i, int64_t size, Wrap wrap) {
  const auto modulo = [](int64_t n, int64_t m) { return ((n % m) + m) % m; };
  switch (wrap) {
    case Wrap::clamp_to_edge:
      return std::clamp<int64_t>(i, 0, size - 1);
    case Wrap::mirrored_repeat: {
      const int64_t k = modulo(i, 2 * size);
      return std::min(k, 2 * size - 1 - k);
    }
    default:
      return modulo(i, size);
  }
}

int64_t whole(double x) {
  return static_cast<int64_t>(std::floor(x));
}

}  // namespace

Cutouts::Cutouts(const Scene& scene) {
  std::vector<int> map_of(scene.textures.size(), -1);
  for (const Material& material : scene.materials) {
    Mask mask;
    mask.factor = double(material.base_color.a);
    mask.cutoff = double(material.alpha_cutoff);
    mask.uv_transform = glm::dmat3(material.uv_transform);
    if (material.alpha_mode == AlphaMode::mask && material.base_color_texture >= 0) {
      const size_t index = static_cast<size_t>(material.base_color_texture);
      if (map_of[index] < 0) {
        map_of[index] = static_cast<int>(maps_.size());
        const Texture& t = scene.textures[index];
        Map map{t.width_px, t.height_px, {}, t.wrap_u, t.wrap_v, t.nearest};
        for (size_t i = 3; i < t.rgba.size(); i += 4) map.alpha.push_back(t.rgba[i]);
        maps_.push_back(std::move(map));
      }
      mask.map = map_of[index];
    }
    masks_.push_back(mask);
  }
}

void Cutouts::add(uint32_t material, const glm::vec2* uvs) {
  entries_.push_back(static_cast<uint32_t>(triangles_.size()));
  Masked triangle{material, {}};
  if (uvs) std::copy_n(uvs, 3, triangle.uv);
  triangles_.push_back(triangle);
}

double Cutouts::Map::texel(int64_t x, int64_t y) const {
  const int64_t row = wrapped(y, height, wrap_v), column = wrapped(x, width, wrap_u);
  return alpha[static_cast<size_t>(row * width + column)] / 255.0;
}

double Cutouts::Map::filtered(const glm::dvec2& at) const {
  if (nearest) return texel(whole(at.x), whole(at.y));
  const glm::dvec2 p = at - 0.5, f = p - glm::floor(p);
  const int64_t x = whole(p.x), y = whole(p.y);
  return (texel(x, y) * (1.0 - f.x) + texel(x + 1, y) * f.x) * (1.0 - f.y) +
         (texel(x, y + 1) * (1.0 - f.x) + texel(x + 1, y + 1) * f.x) * f.y;
}

std::pair<double, double> Cutouts::Map::range(const glm::dvec2& at, const glm::dvec2& radius) const {
  const glm::dvec2 p = nearest ? at : at - 0.5;
  const int64_t more = nearest ? 0 : 1;
  const int64_t x0 = whole(p.x - radius.x), x1 = whole(p.x + radius.x) + more;
  const int64_t y0 = whole(p.y - radius.y), y1 = whole(p.y + radius.y) + more;
  if (x1 - x0 > widest || y1 - y0 > widest) return {0.0, 1.0};
  // No value leaves the texels' range, and none changes faster than neighbours differ.
  double least = 1.0, most = 0.0, slope_x = 0.0, slope_y = 0.0;
  for (int64_t j = y0; j <= y1; ++j)
    for (int64_t i = x0; i <= x1; ++i) {
      const double here = texel(i, j);
      least = std::min(least, here), most = std::max(most, here);
      if (i < x1) slope_x = std::max(slope_x, std::abs(texel(i + 1, j) - here));
      if (j < y1) slope_y = std::max(slope_y, std::abs(texel(i, j + 1) - here));
    }
  if (nearest || least == most) return {least, most};
  const double value = filtered(at), change = slope_x * radius.x + slope_y * radius.y;
  return {std::max(least, value - change), std::min(most, value + change)};
}

bool Cutouts::Mask::passes(double alpha) const {
  return factor * alpha - cutoff >= -alpha_rounding;
}

bool Cutouts::Hit::known() const {
  return std::abs(texel.x) < furthest_texel && std::abs(texel.y) < furthest_texel;
}

Cutouts::Hit Cutouts::locate(const Masked& its, const Map& map, const Corners& t, const glm::dvec3& point,
                             const glm::dvec3& direction) const {
  const glm::dvec3 a(t.a), ab = glm::dvec3(t.b) - a, ac = glm::dvec3(t.c) - a;
  Hit h;
  h.normal = glm::cross(ab, ac);
  h.facing = glm::dot(h.normal, direction);
  h.hit = point + direction * (glm::dot(h.normal, a - point) / h.facing);
  glm::dvec2 corner[3];
  for (int i = 0; i < 3; ++i)
    corner[i] = glm::dvec2(masks_[its.material].uv_transform * glm::dvec3(glm::dvec2(its.uv[i]), 1.0)) *
                glm::dvec2(map.width, map.height);
  // Texels are affine over the triangle's plane.
  const double area2 = glm::dot(h.normal, h.normal);
  h.to_b = glm::cross(ac, h.normal) / area2, h.to_c = glm::cross(h.normal, ab) / area2;
  h.per_b = corner[1] - corner[0], h.per_c = corner[2] - corner[0];
  h.texel = corner[0] + h.per_b * glm::dot(h.to_b, h.hit - a) + h.per_c * glm::dot(h.to_c, h.hit - a);
  return h;
}

bool Cutouts::there(size_t triangle, const Corners& corners, const glm::dvec3& point,
                    const glm::dvec3& direction) const {
  if (!masked(triangle)) return true;
  const Masked& its = triangles_[entries_[triangle]];
  const Mask& mask = masks_[its.material];
  if (mask.map < 0) return mask.passes(1.0);
  const Map& map = maps_[static_cast<size_t>(mask.map)];
  const Hit h = locate(its, map, corners, point, direction);
  return !h.known() || mask.passes(map.filtered(h.texel));
}

Presence Cutouts::within(size_t triangle, const Corners& corners, const Beam& beam) const {
  if (!masked(triangle)) return {};
  const Masked& its = triangles_[entries_[triangle]];
  const Mask& mask = masks_[its.material];
  if (mask.map < 0) return {mask.passes(1.0), true};
  const Map& map = maps_[static_cast<size_t>(mask.map)];
  const Hit h = locate(its, map, corners, beam.point, beam.direction);
  if (!h.known()) return {true, false};

  const double size = glm::length(h.hit) + glm::length(beam.point) + glm::length(glm::dvec3(corners.a));
  const double n = glm::length(h.normal), grazing = n * glm::length(beam.direction) / std::abs(h.facing);
  // The share by which a turn of the line changes the angle at which it meets the plane.
  const double tilt = n * beam.turn / std::abs(h.facing);
  if (!(tilt < 0.25)) return {mask.passes(map.filtered(h.texel)), false};
  glm::dvec2 radius;
  for (int i = 0; i < 2; ++i) {
    // A line moved by m meets the plane at m, less as much of the line as leads back to the plane.
    const glm::dvec3 gradient = h.to_b * h.per_b[i] + h.to_c * h.per_c[i];
    const glm::dvec3 seen = gradient - h.normal * (glm::dot(gradient, beam.direction) / h.facing);
    const double steepest = glm::length(seen) + 2.0 * tilt * (1.0 + grazing) * glm::length(gradient);
    const double r =
        1.01 * beam.reach * steepest + texel_rounding * (size * grazing * glm::length(gradient) + std::abs(h.texel[i]));
    radius[i] = r < double(widest) ? r : double(widest);  // also NaN
  }
  const auto [least, most] = map.range(h.texel, radius);
  const bool there = mask.passes(map.filtered(h.texel));
  // A flat or a total mask is decided by whatever rounds least.
  const double a = mask.factor * least - mask.cutoff, b = mask.factor * most - mask.cutoff;
  const bool certain = least == most || (mask.cutoff <= 0.0 && mask.factor >= 0.0);
  return {there, certain || (there ? std::min(a, b) >= alpha_rounding : std::max(a, b) < -alpha_rounding)};
}

}  // namespace izb::reference

// SPDX-License-Identifier: MIT
// Looks of the irregular z-buffer: micro-quads, lists, tests and the layers of the grid, as heat maps.
#include <cmath>

#include "shared/lists.h"
#include "view/color_scale.h"
#include "view/light_space.h"
#include "view/look_pictures.h"

namespace izb::draw {
namespace {

constexpr float none = -1.0f;           // in place of a value
constexpr Rgb unused_color{8, 20, 22};  // texels beyond those in use

/// A heat map of the values that are not `none`, over another picture.
LookPicture heat(const std::vector<float>& values, Image8 background, bool logarithmic, const char* unit) {
  std::vector<float> there;
  for (const float v : values)
    if (v != none) there.push_back(v);
  const ColorScale scale = logarithmic ? log_scale_of(std::move(there)) : scale_of(std::move(there));
  LookPicture look{std::move(background), with_unit(scale.low, unit), with_unit(scale.high, unit)};
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i] != none) put(look.picture, i, scale.color(values[i]));
  return look;
}

/// The surfaces, so dark that colours of the scale stand out.
Image8 grey_picture(const Snapshot& s) {
  Image8 picture = blank(s.width_px, s.height_px);
  for (size_t i = 0; i < s.size(); ++i)
    if (s.gbuffer.eye_distance[i] > 0.0f) put(picture, i, dimmed({255, 255, 255}, 0.7f * dim_grey(s, i)));
  return picture;
}

/// A heat map of value(i) of each receiver.
template <typename Value>
LookPicture of_receivers(const Snapshot& s, bool logarithmic, const char* unit, Value&& value) {
  std::vector<float> values(s.size(), none);
  for (size_t i = 0; i < values.size(); ++i)
    if (class_of(s, i) == shared::class_receiver) values[i] = value(i);
  return heat(values, grey_picture(s), logarithmic, unit);
}

/// value(texel of all layers) of each texel of one layer that is in use, last row first.
template <typename Value>
LookPicture of_texels(const Snapshot& s, int layer, bool logarithmic, const char* unit, Value&& value) {
  const IzbInternals& izb = *s.built;
  const int side = size_t(layer) < s.windows.size() ? static_cast<int>(s.windows[size_t(layer)].guard.y) : izb.grid;
  std::vector<float> values;
  for (int y = izb.grid - 1; y >= 0; --y)
    for (int x = 0; x < izb.grid; ++x) values.push_back(x < side && y < side ? value(izb.texel({x, y}, layer)) : none);
  LookPicture look = heat(values, blank(izb.grid, izb.grid), logarithmic, unit);
  for (int y = 0; y < izb.grid; ++y)
    for (int x = 0; x < izb.grid; ++x)
      if (x >= side || izb.grid - 1 - y >= side)
        put(look.picture, size_t(y) * size_t(izb.grid) + size_t(x), unused_color);
  return look;
}

/// The nodes of each pixel, top row first.
std::vector<uint32_t> nodes_of_pixels(const Snapshot& s, const IzbInternals& izb) {
  std::vector<uint32_t> counts(s.size(), 0);
  for (const uint32_t node : izb.lists.nodes) {
    const glm::ivec2 px = shared::pixel_from_node(node);
    ++counts[s.index({px.x, s.height_px - 1 - px.y})];
  }
  return counts;
}

float cross(const glm::vec2& a, const glm::vec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

// Long over short axis of the parallelogram that the micro-quad nearly is: the singular values of its sides.
LookPicture elongation(const Snapshot& s, int) {
  return of_receivers(s, true, ": 1", [&](size_t i) {
    const shared::QuadOnGrid q = quad_on_grid(s, i);
    const glm::dvec2 along_x = 0.5 * glm::dvec2(q.corner1 - q.corner0 + q.corner2 - q.corner3);
    const glm::dvec2 along_y = 0.5 * glm::dvec2(q.corner3 - q.corner0 + q.corner2 - q.corner1);
    const double area = std::abs(along_x.x * along_y.y - along_x.y * along_y.x);
    const double sum = glm::dot(along_x, along_x) + glm::dot(along_y, along_y);
    constexpr double most = 1e6;  // edge-on
    const double root = std::sqrt(std::max(sum * sum - 4.0 * area * area, 0.0));
    return static_cast<float>(sum + root < 2.0 * area * most ? (sum + root) / (2.0 * area) : most);
  });
}

LookPicture footprint(const Snapshot& s, int) {
  return of_receivers(s, true, "texels", [&](size_t i) {
    const shared::QuadOnGrid q = quad_on_grid(s, i);
    const float area = 0.5f * std::abs(cross(glm::vec2(q.corner2 - q.corner0), glm::vec2(q.corner3 - q.corner1)));
    return std::max(area, 1e-6f);
  });
}

LookPicture list_length(const Snapshot& s, int) {
  return of_receivers(s, false, "nodes", [&](size_t i) { return s.list_length[i]; });
}

LookPicture tests(const Snapshot& s, int) {
  return of_receivers(s, false, "tests", [&](size_t i) { return s.tests[i]; });
}

LookPicture removed(const Snapshot& s, int) {
  const std::vector<uint32_t> built = nodes_of_pixels(s, *s.built), left = nodes_of_pixels(s, *s.left);
  const ColorScale percent{0.0f, 100.0f, false};
  LookPicture look{grey_picture(s), "0 %", "100 %"};
  for (size_t i = 0; i < s.size(); ++i)
    if (built[i] != 0) put(look.picture, i, percent.color(100.0f * (1.0f - float(left[i]) / float(built[i]))));
  return look;
}

LookPicture grid_lists(const Snapshot& s, int layer) {
  return of_texels(s, layer, false, "nodes", [&](size_t texel) {
    const size_t length = s.built->lists[texel].size();
    return length != 0 ? float(length) : none;
  });
}

// Depths of receivers lie in [1/4, 3/4].
LookPicture grid_zcull(const Snapshot& s, int layer) {
  LookPicture look = of_texels(s, layer, false, "", [&](size_t texel) {
    const float furthest = s.built->furthest[texel];
    return furthest > 0.0f ? std::clamp(2.0f * furthest - 0.5f, 0.0f, 1.0f) : none;
  });
  look.low = "nearest to the light";
  look.high = "furthest from it";
  return look;
}

LookPicture grid_fragments(const Snapshot& s, int layer) {
  return of_texels(s, layer, false, "fragments", [&](size_t texel) { return s.fragments[texel]; });
}

}  // namespace izb::draw

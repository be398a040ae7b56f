// SPDX-License-Identifier: MIT
#include "view/looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "frame/spine.h"
#include "view/look_pictures.h"

namespace izb {
namespace {

constexpr const char* gbuffer = name(Stage::gbuffer);
constexpr const char* bounds = name(Stage::bounds);
constexpr const char* build = name(Stage::build);
constexpr const char* zcull = name(Stage::zcull);
constexpr const char* visibility = name(Stage::visibility);
constexpr const char* shade = name(Stage::shade);

constexpr Look all[] = {
    {"depth", gbuffer, "distance from the eye, logarithmic: dark is near", 0, false, draw::depth},
    {"normal", gbuffer, "which way the triangle faces in the world: red +x, green +y, blue +z", 0, false, draw::normal},
    {"triangle", gbuffer, "each triangle in a colour of its own", 0, false, draw::triangle},
    {"instance", gbuffer, "each object in a colour of its own", 0, false, draw::instance},
    {"albedo", gbuffer, "the surface's colour before any light", Need::albedo, false, draw::albedo},
    {"light-class", bounds,
     "who asks for shadows: yellow faces the light, blue faces away from it, purple is outside its cone", 0, false,
     draw::light_class},
    {"cascade", bounds, "into which cascade, or which face around the light, a pixel falls; grey: none", Need::windows,
     false, draw::cascade},
    {"elongation", bounds, "how many times as long as wide a pixel looks from the light, on the grid",
     Need::windows | Need::micro_quads, false, draw::elongation},
    {"footprint", bounds, "how many texels of the light's grid a pixel's area takes", Need::windows | Need::micro_quads,
     false, draw::footprint},
    {"list-length", build, "how many nodes the longest list has in which the pixel stands", Need::list_length, false,
     draw::list_length},
    {"grid-lists", build, "the light's grid: how many nodes each texel's list has", Need::built, true,
     draw::grid_lists},
    {"grid-zcull", zcull, "the light's grid: depth behind which a triangle can shadow nothing; bright is far",
     Need::built | Need::furthest, true, draw::grid_zcull},
    {"visibility", visibility, "share of the pixel's samples that see the light: white is lit; blue asks for none",
     Need::mask, false, draw::visibility},
    {"tests", visibility, "how many triangles were tested against the pixel", Need::tests, false, draw::tests},
    {"removed", visibility, "share of the pixel's nodes that were taken out of the lists when it was all shadow",
     Need::built | Need::left, false, draw::removed},
    {"errors", visibility, "against rays: orange is lit but should be shadow, blue is shadow but should be lit",
     Need::mask | Need::truth, false, draw::errors},
    {"grid-fragments", visibility, "the light's grid: how many triangles visited each texel",
     Need::built | Need::fragments, true, draw::grid_fragments},
    {"shading-normal", shade, "the normal that shading takes, smooth over curved objects", Need::shading_normal, false,
     draw::shading_normal},
};

}  // namespace

std::span<const Look> looks() {
  return all;
}

const Look* find_look(std::string_view name) {
  const auto found = std::find_if(std::begin(all), std::end(all), [&](const Look& look) { return look.name == name; });
  return found == std::end(all) ? nullptr : found;
}

unsigned available(const Snapshot& s) {
  unsigned there = 0;
  const auto add = [&](bool is_there, unsigned flag) { there |= is_there ? flag : 0u; };
  add(!s.albedo.empty(), Need::albedo);
  add(!s.shading_normal.empty(), Need::shading_normal);
  add(!s.gbuffer.micro_quad.empty(), Need::micro_quads);
  add(!s.mask.empty(), Need::mask);
  add(!s.truth.empty(), Need::truth);
  add(!s.list_length.empty(), Need::list_length);
  add(!s.tests.empty(), Need::tests);
  add(!s.fragments.empty(), Need::fragments);
  add(!s.windows.empty(), Need::windows);
  add(s.built.has_value(), Need::built);
  add(s.built && !s.built->furthest.empty(), Need::furthest);
  add(s.left.has_value(), Need::left);
  return there;
}

LookPicture paint(const Look& look, const Snapshot& snapshot, int layer) {
  if ((look.needs & ~available(snapshot)) != 0)
    throw std::logic_error(fmt::format("the snapshot lacks what the view '{}' shows", look.name));
  if (look.of_grid && (layer < 0 || layer >= snapshot.built->layers))
    throw std::logic_error(fmt::format("the grid has no layer {}", layer));
  return look.draw(snapshot, layer);
}

}  // namespace izb

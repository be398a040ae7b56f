// SPDX-License-Identifier: MIT
// Views of single stages over snapshots whose pictures are known beforehand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "frame/spine.h"
#include "image/heat_map.h"
#include "shared/lists.h"
#include "view/color_scale.h"
#include "view/light_space.h"
#include "view/looks.h"
#include "view_fixture.h"

namespace izb::test {
namespace {

LookPicture paint(const char* name, const Snapshot& snapshot, int layer = 0) {
  const Look* look = find_look(name);
  if (!look) throw std::logic_error(name);
  return izb::paint(*look, snapshot, layer);
}

/// Lists of one layer of that side, from pixels that count from the bottom.
IzbInternals lists_of(int grid, int layers, const std::vector<std::pair<size_t, std::vector<glm::ivec2>>>& of_texels) {
  IzbInternals izb;
  izb.grid = grid;
  izb.layers = layers;
  const size_t texels = size_t(grid) * size_t(grid) * size_t(layers);
  for (size_t texel = 0; texel < texels; ++texel) {
    izb.lists.first.push_back(static_cast<uint32_t>(izb.lists.nodes.size()));
    for (const auto& [its, pixels] : of_texels)
      for (const glm::ivec2& px : pixels)
        if (its == texel)
          izb.lists.nodes.push_back(shared::node_from_pixel(px, static_cast<int>(izb.lists.nodes.size() % 8)));
  }
  izb.lists.first.push_back(static_cast<uint32_t>(izb.lists.nodes.size()));
  return izb;
}

TEST(ViewScale, NiceNumbersAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_FLOAT_EQ(nice_above(0.7f), 1.0f);
  EXPECT_FLOAT_EQ(nice_above(1.0f), 1.0f);
  EXPECT_FLOAT_EQ(nice_above(130.0f), 200.0f);
  EXPECT_FLOAT_EQ(nice_above(0.021f), 0.05f);
  EXPECT_FLOAT_EQ(nice_below(0.021f), 0.02f);
  EXPECT_FLOAT_EQ(nice_below(9.9f), 5.0f);
  EXPECT_FLOAT_EQ(nice_below(10.0f), 10.0f);
}

TEST(ViewScale, AFewExtremeValuesDoNotSpoilIt) {
  std::vector<float> values(1000, 30.0f);
  std::fill_n(values.begin(), 4, 1e6f);
  EXPECT_FLOAT_EQ(scale_of(values).high, 50.0f);
  std::fill_n(values.begin(), 100, 1e6f);
  EXPECT_FLOAT_EQ(scale_of(values).high, 1e6f);
  const ColorScale log = log_scale_of({0.3f, 3.0f, 40.0f});
  EXPECT_FLOAT_EQ(log.low, 0.2f);
  EXPECT_FLOAT_EQ(log.high, 50.0f);
  EXPECT_EQ(log.color(std::sqrt(0.2f * 50.0f)), heat_color(0.5f));
}

TEST(ViewScale, NoValuesGiveAScaleThatCanBeShown) {
  EXPECT_GT(scale_of({}).high, 0.0f);
  EXPECT_GT(scale_of({0.0f}).high, 0.0f);
  EXPECT_GT(log_scale_of({}).low, 0.0f);
  const ColorScale one = log_scale_of({2.0f});
  EXPECT_GT(one.high, one.low);
}

TEST(ViewLooks, HaveNamesOfTheirOwnAndStagesOfTheSpine) {
  std::set<std::string> names;
  for (const Look& look : looks()) {
    EXPECT_TRUE(names.insert(look.name).second) << look.name;
    EXPECT_EQ(find_look(look.name), &look);
    EXPECT_NE(std::find_if(stage_names.begin(), stage_names.end(),
                           [&](const char* stage) { return std::string(stage) == look.stage; }),
              stage_names.end())
        << look.name;
    EXPECT_EQ(look.of_grid, (look.needs & Need::built) != 0 && (look.needs & Need::left) == 0) << look.name;
  }
  EXPECT_EQ(find_look("no such look"), nullptr);
}

TEST(ViewLooks, RefuseWhatIsMissingAndPaintWhatIsThere) {
  Snapshot s = floor_from_above(4, 3);
  EXPECT_EQ(available(s), Need::micro_quads | Need::windows);
  for (const Look& look : looks()) {
    if ((look.needs & ~available(s)) != 0) {
      EXPECT_THROW(izb::paint(look, s, 0), std::logic_error) << look.name;
      continue;
    }
    const Image8 picture = izb::paint(look, s, 0).picture;
    EXPECT_EQ(picture.width_px, 4) << look.name;
    EXPECT_EQ(picture.pixels.size(), 4u * 3u * 3u) << look.name;
  }
  s.built = lists_of(16, 1, {});
  EXPECT_EQ(available(s), Need::micro_quads | Need::windows | Need::built);
  EXPECT_NO_THROW(paint("grid-lists", s, 0));
  EXPECT_THROW(paint("grid-lists", s, 1), std::logic_error);
  EXPECT_THROW(paint("grid-lists", s, -1), std::logic_error);
}

TEST(ViewLooks, DepthIsLogarithmic) {
  Snapshot s = floor_from_above(4, 1);
  s.gbuffer.eye_distance = {1.0f, 10.0f, 100.0f, 0.0f};
  const LookPicture look = paint("depth", s);
  EXPECT_EQ(look.low, "1 m");
  EXPECT_EQ(look.high, "100 m");
  EXPECT_EQ(color_at(look.picture, 0, 0), heat_color(0.0f));
  EXPECT_EQ(color_at(look.picture, 1, 0), heat_color(0.5f));
  EXPECT_EQ(color_at(look.picture, 2, 0), heat_color(1.0f));
  EXPECT_EQ(color_at(look.picture, 3, 0), nothing_color);
}

TEST(ViewLooks, NormalsAreOfTheWorldAndSmoothOnesStandInWhereThereAreSome) {
  Snapshot s = floor_from_above(2, 1);
  // The camera looks down: its z axis is the world's y.
  s.camera_ws.world_from_view =
      glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(5, 6, 7, 1));
  EXPECT_EQ(color_at(paint("normal", s).picture, 0, 0), (Rgb{128, 255, 128}));
  s.shading_normal = {glm::vec3(0), glm::normalize(glm::vec3(-1, 0, -0.001))};  // away from the viewer
  EXPECT_EQ(color_at(paint("shading-normal", s).picture, 0, 0), (Rgb{128, 255, 128}));
  EXPECT_EQ(color_at(paint("shading-normal", s).picture, 1, 0), (Rgb{255, 128, 128}));
  s.gbuffer.normal[0] = shared::octahedral_none();
  EXPECT_EQ(color_at(paint("normal", s).picture, 0, 0), nothing_color);
}

TEST(ViewLooks, AlbedoIsShownInSrgb) {
  Snapshot s = floor_from_above(1, 1);
  s.albedo = {glm::vec3(0.0f, 0.2158605f, 1.0f)};  // sRGB 0, 128, 255
  EXPECT_EQ(color_at(paint("albedo", s).picture, 0, 0), (Rgb{0, 128, 255}));
}

TEST(ViewLooks, TrianglesOfOneInstanceDifferAndItsInstanceDoesNot) {
  Snapshot s = floor_from_above(3, 1);
  s.gbuffer.id = {glm::uvec2(1, 0), glm::uvec2(1, 1), glm::uvec2(2, 0)};
  const Image8 triangle = paint("triangle", s).picture, instance = paint("instance", s).picture;
  EXPECT_NE(color_at(triangle, 0, 0), color_at(triangle, 1, 0));
  EXPECT_NE(color_at(triangle, 0, 0), color_at(triangle, 2, 0));
  EXPECT_EQ(color_at(instance, 0, 0), color_at(instance, 1, 0));
  EXPECT_NE(color_at(instance, 0, 0), color_at(instance, 2, 0));
}

TEST(ViewLooks, VisibilityIsTheShareOfLitSamples) {
  Snapshot s = floor_from_above(4, 1);
  s.mask = {0u, ~0u, 0x0000ffffu, 0u};
  s.gbuffer.normal[3] = shared::octahedral_encode(glm::vec3(0, 0, -1));  // away from the light
  const Image8 picture = paint("visibility", s).picture;
  EXPECT_EQ(color_at(picture, 0, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(color_at(picture, 1, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(color_at(picture, 2, 0), (Rgb{128, 128, 128}));
  const Rgb culled = color_at(picture, 3, 0);
  EXPECT_GT(culled[2], culled[0]);
}

TEST(ViewLooks, ErrorsTellLeaksFromFalseShadowAndManyFromFew) {
  Snapshot s = floor_from_above(4, 1);
  s.mask = {~0u, 0u, 1u, 0u};
  s.truth = {0u, ~0u, 0u, 0u};
  const Image8 picture = paint("errors", s).picture;
  const Rgb falsely = color_at(picture, 0, 0), leak = color_at(picture, 1, 0), one_bit = color_at(picture, 2, 0),
            right = color_at(picture, 3, 0);
  EXPECT_GT(leak[0], leak[2]);
  EXPECT_GT(falsely[2], falsely[0]);
  EXPECT_GT(one_bit[2], one_bit[0]);
  EXPECT_LT(one_bit[2], falsely[2]);
  EXPECT_EQ(right[0], right[2]);
}

TEST(ViewLooks, LightClassesHaveColoursOfTheirOwn) {
  Snapshot s = floor_from_above(4, 1);
  s.light = make_light({0, 0, -1}, nullptr);
  const glm::dvec3 lamp(0.5, 0.5, -9.0);  // 1 m above the first pixel, a cone of 60 degrees
  s.light = make_light({0, 0, -1}, &lamp);
  s.light.grid = glm::uvec4(16, 1, 1, 0);
  s.gbuffer.normal[1] = shared::octahedral_encode(glm::vec3(0, 0, -1));
  s.gbuffer.eye_distance[3] = 0.0f;
  const Image8 picture = paint("light-class", s).picture;
  const Rgb receiver = color_at(picture, 0, 0), culled = color_at(picture, 1, 0), outside = color_at(picture, 2, 0);
  EXPECT_GT(receiver[1], receiver[2]);
  EXPECT_GT(culled[2], culled[0]);
  EXPECT_GT(outside[0], outside[1]);
  EXPECT_EQ(color_at(picture, 3, 0), nothing_color);
}

TEST(ViewLooks, CascadesEndWhereTheBoundsStageSays) {
  Snapshot s = floor_from_above(4, 1);
  s.gbuffer.eye_distance = {1.0f, 2.0f, 2.5f, 9.0f};
  s.light.grid.y = 3;
  s.cascades.ends[0] = glm::vec4(2.0f, 5.0f, 3.0e38f, 0.0f);
  for (const auto& [px, cascade] : {std::pair{0, 0}, {1, 0}, {2, 1}, {3, 2}})
    EXPECT_EQ(layer_of(s, size_t(px)), cascade);
  s.windows.resize(3, s.windows[0]);
  const Image8 picture = paint("cascade", s).picture;
  EXPECT_EQ(color_at(picture, 0, 0), color_at(picture, 1, 0));
  EXPECT_NE(color_at(picture, 1, 0), color_at(picture, 2, 0));
  EXPECT_NE(color_at(picture, 2, 0), color_at(picture, 3, 0));
}

TEST(ViewLooks, FacesCountBeforeCascades) {
  Snapshot s = floor_from_above(4, 1);
  const glm::dvec3 lamp(0.5, 0.5, -9.0);
  s.light = make_light({0, 0, -1}, &lamp);
  s.light.axis_x = glm::vec4(1, 0, 0, 0);
  s.light.axis_y = glm::vec4(0, -1, 0, 0);
  s.light.to_light.w = -1.0f;
  s.light.grid = glm::uvec4(16, 2, 6, 0);
  s.cascades.ends[0] = glm::vec4(5.0f, 3.0e38f, 0, 0);
  EXPECT_EQ(layer_of(s, 0), 1);  // below the lamp, the second cascade
  EXPECT_EQ(layer_of(s, 3), 5);  // 3 m to the right of it: face 2
}

// A pixel of 1 m is one texel; twice as wide along x where the grid has twice as many texels there.
TEST(ViewLooks, FootprintAndElongationAreThoseOfTheProjectedMicroQuad) {
  Snapshot s = floor_from_above(4, 3);
  shared::QuadOnGrid q = quad_on_grid(s, 0);  // the upper left pixel: x 0..1, y 2..3
  EXPECT_FLOAT_EQ(q.corner0.x, 1.0f);
  EXPECT_FLOAT_EQ(q.corner0.y, 3.0f);
  EXPECT_FLOAT_EQ(q.corner2.x, 2.0f);
  EXPECT_FLOAT_EQ(q.corner2.y, 4.0f);
  EXPECT_FLOAT_EQ(q.corner0.z, 0.5f);
  s.windows[0].window.z = 4.0f;
  s.windows[0].window.w = 0.5f;
  const LookPicture elongation = paint("elongation", s), footprint = paint("footprint", s);
  EXPECT_EQ(elongation.low, "5 : 1");
  EXPECT_EQ(elongation.high, "10 : 1");
  const auto share = float(std::log(8.0 / 5.0) / std::log(10.0 / 5.0));
  EXPECT_EQ(color_at(elongation.picture, 1, 1), heat_color(share));
  EXPECT_EQ(footprint.low, "2 texels");
  EXPECT_EQ(color_at(footprint.picture, 1, 1), heat_color(0.0f));
}

TEST(ViewLooks, HeatMapsOfThePixelsLeaveOutWhoIsNoReceiver) {
  Snapshot s = floor_from_above(3, 1);
  s.gbuffer.eye_distance[2] = 0.0f;
  s.list_length = {4.0f, 20.0f, 1e6f};
  s.tests = {0.0f, 100.0f, 1e6f};
  const LookPicture lists = paint("list-length", s), tests = paint("tests", s);
  EXPECT_EQ(lists.low, "0 nodes");
  EXPECT_EQ(lists.high, "20 nodes");
  EXPECT_EQ(color_at(lists.picture, 0, 0), heat_color(0.2f));
  EXPECT_EQ(color_at(lists.picture, 2, 0), nothing_color);
  EXPECT_EQ(tests.high, "100 tests");
  EXPECT_EQ(color_at(tests.picture, 1, 0), heat_color(1.0f));
}

TEST(ViewLooks, GridPicturesHaveTheLastRowOnTop) {
  Snapshot s = floor_from_above(4, 3);
  s.windows.resize(2, s.windows[0]);
  s.windows[1].guard.y = 3.0f;
  s.light.grid.y = 2;
  s.built = lists_of(4, 2, {{1, {{0, 0}}}, {16 + 8, {{1, 0}, {2, 0}}}});  // (1, 0) of layer 0; (0, 2) of layer 1
  s.built->furthest.assign(32, 0.0f);
  s.built->furthest[1] = 0.75f;
  s.fragments.assign(32, 0.0f);
  s.fragments[16 + 8] = 10.0f;
  const LookPicture first = paint("grid-lists", s, 0), second = paint("grid-lists", s, 1);
  EXPECT_EQ(first.picture.width_px, 4);
  EXPECT_EQ(first.picture.height_px, 4);
  EXPECT_EQ(first.high, "1 nodes");
  EXPECT_EQ(second.high, "2 nodes");
  EXPECT_EQ(color_at(first.picture, 1, 3), heat_color(1.0f));
  EXPECT_EQ(color_at(first.picture, 1, 0), nothing_color);
  EXPECT_EQ(color_at(second.picture, 0, 1), heat_color(1.0f));
  EXPECT_NE(color_at(second.picture, 0, 0), nothing_color);  // row 3 is not in use
  EXPECT_NE(color_at(second.picture, 0, 0), heat_color(0.0f));
  EXPECT_EQ(color_at(paint("grid-zcull", s, 0).picture, 1, 3), heat_color(1.0f));
  EXPECT_EQ(color_at(paint("grid-zcull", s, 0).picture, 0, 3), nothing_color);
  EXPECT_EQ(color_at(paint("grid-fragments", s, 1).picture, 0, 1), heat_color(1.0f));
  EXPECT_EQ(color_at(paint("grid-fragments", s, 1).picture, 1, 1), heat_color(0.0f));
}

TEST(ViewLooks, RemovedIsTheShareOfNodesThatAreNotLeft) {
  Snapshot s = floor_from_above(3, 2);
  s.built = lists_of(4, 1, {{0, {{0, 0}, {1, 1}}}, {5, {{0, 0}, {2, 0}}}});
  s.left = lists_of(4, 1, {{0, {{1, 1}}}, {5, {{0, 0}}}});
  const Image8 picture = paint("removed", s).picture;
  EXPECT_EQ(color_at(picture, 0, 1), heat_color(0.5f));
  EXPECT_EQ(color_at(picture, 1, 0), heat_color(0.0f));
  EXPECT_EQ(color_at(picture, 2, 1), heat_color(1.0f));
  const Rgb without = color_at(picture, 0, 0);
  EXPECT_EQ(without[0], without[2]);
}

TEST(ViewLightSpace, PixelsAndTexelsCountRowsFromTheSideThatTheyShould) {
  Snapshot s = floor_from_above(3, 2);
  s.built = lists_of(4, 2, {{6, {{0, 0}, {2, 1}, {0, 0}}}, {16, {{2, 1}}}});
  EXPECT_EQ(pixels_of_texel(s, {2, 1}, 0), (std::vector<glm::ivec2>{{2, 0}, {0, 1}}));
  EXPECT_TRUE(pixels_of_texel(s, {2, 2}, 0).empty());
  using Texels = std::vector<std::pair<int, glm::ivec2>>;
  EXPECT_EQ(texels_of_pixel(s, {2, 0}), (Texels{{0, {2, 1}}, {1, {0, 0}}}));
  EXPECT_EQ(texels_of_pixel(s, {0, 1}), (Texels{{0, {2, 1}}}));
  EXPECT_TRUE(texels_of_pixel(s, {0, 0}).empty());
}

TEST(ViewLightSpace, AWindowIsABoxInTheWorld) {
  Snapshot s = floor_from_above(4, 3);
  s.camera_ws.world_from_view = glm::dmat4(1.0);
  s.camera_ws.world_from_view[3] = glm::dvec4(100, 0, 0, 1);
  s.windows.push_back({glm::vec4(0, 0, 1, 1), glm::vec4(0), glm::vec4(0)});  // no receiver
  const auto frusta = cascade_frusta_ws(s);
  ASSERT_EQ(frusta.size(), 2u);
  // Texels 0 to 16 are -1 to 15 m; depths 1/4 to 3/4 are 9 to 11 m below the eye.
  EXPECT_EQ(frusta[0][0], glm::dvec3(99, -1, -9));
  EXPECT_EQ(frusta[0][1], glm::dvec3(115, -1, -9));
  EXPECT_EQ(frusta[0][2], glm::dvec3(99, 15, -9));
  EXPECT_EQ(frusta[0][7], glm::dvec3(115, 15, -11));
  for (const glm::dvec3& corner : frusta[1]) EXPECT_EQ(corner, glm::dvec3(100, 0, 0));
}

TEST(ViewLightSpace, AWindowOfALampIsAPartOfAPyramid) {
  Snapshot s = floor_from_above(4, 3);
  s.camera_ws.world_from_view = glm::dmat4(1.0);
  const glm::dvec3 lamp(2, 1, -6);
  s.light = make_light({0, 0, -1}, &lamp);
  s.light.axis_x = glm::vec4(1, 0, 0, 0);
  s.light.axis_y = glm::vec4(0, 1, 0, 0);
  s.light.grid = glm::uvec4(16, 1, 1, 0);
  // u and v from -1 to 1; depths 2 to 4 m, d from -1/2 to -1/4.
  s.windows[0] = {glm::vec4(-1, -1, 8, 8), glm::vec4(1.25f, 2.0f, 0, 0), glm::vec4(0, 16, 0, 0)};
  const auto frustum = cascade_frusta_ws(s)[0];
  EXPECT_EQ(frustum[0], glm::dvec3(0, -1, -8));
  EXPECT_EQ(frustum[3], glm::dvec3(4, 3, -8));
  EXPECT_EQ(frustum[4], glm::dvec3(-2, -3, -10));
  EXPECT_EQ(frustum[7], glm::dvec3(6, 5, -10));
}

}  // namespace
}  // namespace izb::test

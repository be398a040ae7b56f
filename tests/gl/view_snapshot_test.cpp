// SPDX-License-Identifier: MIT
// Snapshots of rendered frames: what the lens says of every pixel is its mask, and the lists' both directions agree.
#include <algorithm>
#include <bit>

#include "gl/frame_fixture.h"
#include "shared/lists.h"
#include "view/light_space.h"
#include "view/pixel_probe.h"
#include "view/take_snapshot.h"

namespace izb::test {
namespace {

constexpr int width_px = 48, height_px = 36;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "128"}};

struct Shot {
  Snapshot snapshot;
  std::vector<glm::vec3> triangles_vs;
};

/// Of the last light.
Shot shoot(const Scene& scene, const Camera& eye, const std::vector<Light>& lights, const Settings& settings,
           unsigned needs = ~0u) {
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set_options(*technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, lights);
  gpu::StageTimers timers(true);
  renderer.render(eye, lights, timers);
  return {take_snapshot(renderer, *technique, eye, lights.size() - 1, needs), renderer.inputs().triangles_vs()};
}

/// The samples inside an occluder's lines.
uint32_t bits_within(const Snapshot& s, const std::array<glm::dvec3, 4>& lines) {
  uint32_t bits = 0;
  for (size_t n = 0; n < s.samples.offsets_px.size(); ++n)
    if (std::all_of(lines.begin(), lines.end(),
                    [&](const glm::dvec3& line) { return shared::plane_at(line, s.samples.offsets_px[n]) >= 0.0; }))
      bits |= 1u << n;
  return bits;
}

/// How many pixels are partly hidden.
size_t expect_probes_are_the_mask(const Shot& shot) {
  const Snapshot& s = shot.snapshot;
  size_t partly = 0;
  for (int y = 0; y < s.height_px; ++y)
    for (int x = 0; x < s.width_px; ++x) {
      const ProbedPixel p = probe(s, shot.triangles_vs, {x, y});
      EXPECT_EQ(p.hidden, s.mask[s.index({x, y})]) << x << " " << y;
      EXPECT_EQ(p.mask, s.mask[s.index({x, y})]);
      uint32_t listed = 0;
      for (const Occluder& o : p.occluders) {
        listed |= o.bits;
        if (s.samples.count() > 1) {
          EXPECT_EQ(bits_within(s, o.lines), o.bits) << x << " " << y;
        }
      }
      EXPECT_TRUE(listed == p.hidden || p.counts[0] > most_occluders);
      partly += p.hidden != 0u && p.hidden != ~0u;
    }
  return partly;
}

void expect_lists_agree(const Snapshot& s) {
  const IzbInternals& izb = *s.built;
  size_t in_pixels = 0, in_texels = 0, in_lists = 0;
  for (int y = 0; y < s.height_px; ++y)
    for (int x = 0; x < s.width_px; ++x)
      for (const auto& [layer, texel] : texels_of_pixel(s, {x, y})) {
        const std::vector<glm::ivec2> pixels = pixels_of_texel(s, texel, layer);
        EXPECT_NE(std::find(pixels.begin(), pixels.end(), glm::ivec2(x, y)), pixels.end()) << x << " " << y;
        ++in_pixels;
      }
  for (int layer = 0; layer < izb.layers; ++layer)
    for (int y = 0; y < izb.grid; ++y)
      for (int x = 0; x < izb.grid; ++x) {
        in_lists += izb.lists[izb.texel({x, y}, layer)].size();
        in_texels += pixels_of_texel(s, {x, y}, layer).size();
      }
  EXPECT_EQ(in_pixels, in_texels);
  EXPECT_EQ(in_lists, izb.lists.nodes.size());
  EXPECT_GT(in_pixels, size_t{width_px * height_px / 3});
}

/// Every receiver's point lies within the box or pyramid of its layer, by the six planes through its corners, and each
/// of these has one not far from it: windows hold whole micro-quads.
void expect_frusta_hold_the_receivers(const Snapshot& s) {
  const auto frusta = cascade_frusta_ws(s);
  constexpr std::array<std::array<int, 4>, 6> sides{{{0, 2, 4, 1},
                                                     {1, 3, 5, 0},
                                                     {0, 1, 4, 2},
                                                     {2, 3, 6, 0},
                                                     {0, 1, 2, 4},
                                                     {4, 5, 6, 0}}};  // three corners, one opposite
  std::vector<size_t> held(frusta.size(), 0);
  std::vector<std::array<double, 6>> nearest(frusta.size(), {1, 1, 1, 1, 1, 1});  // as a share of the way across
  for (size_t i = 0; i < s.size(); ++i) {
    if (class_of(s, i) != shared::class_receiver) continue;
    const auto layer = static_cast<size_t>(layer_of(s, i));
    const auto& corners = frusta[layer];
    const glm::dvec3 p =
        s.camera_ws.world_from_view * glm::dvec4(glm::dvec3(receiver_point_vs(s.gbuffer, s.camera, i)), 1.0);
    for (size_t k = 0; k < sides.size(); ++k) {
      const glm::dvec3 a = corners[size_t(sides[k][0])];
      const glm::dvec3 n =
          glm::normalize(glm::cross(corners[size_t(sides[k][1])] - a, corners[size_t(sides[k][2])] - a));
      const double across = glm::dot(n, corners[size_t(sides[k][3])] - a);
      const double inside = glm::dot(n, p - a) / across;
      EXPECT_GT(inside, -1e-5) << "pixel " << i << ", layer " << layer << ", side " << k;
      nearest[layer][k] = std::min(nearest[layer][k], inside);
    }
    ++held[layer];
  }
  EXPECT_GT(*std::max_element(held.begin(), held.end()), 100u);
  for (size_t layer = 0; layer < held.size(); ++layer) {
    if (held[layer] == 0) continue;  // perhaps a part of a micro-quad
    for (size_t k = 0; k < sides.size(); ++k)
      EXPECT_TRUE(nearest[layer][k] < 0.35 || held[layer] < 100) << layer << " " << k << " " << nearest[layer][k];
  }
}

TEST(ViewSnapshot, ProbesAreTheMaskUnderASun) {
  const Shot shot = shoot(tangle(80, 300), camera, {sun(130, 35)}, with(exact, {{"cascades", "3"}}));
  EXPECT_GT(expect_probes_are_the_mask(shot), 100u);
  expect_lists_agree(shot.snapshot);
  expect_frusta_hold_the_receivers(shot.snapshot);
}

TEST(ViewSnapshot, ProbesAreTheMaskUnderASpot) {
  const Light light = spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40);
  const Shot shot = shoot(tangle(81, 300), camera, {light}, exact);
  EXPECT_GT(expect_probes_are_the_mask(shot), 50u);
  expect_lists_agree(shot.snapshot);
  expect_frusta_hold_the_receivers(shot.snapshot);
}

TEST(ViewSnapshot, ProbesAreTheMaskOfAnOrthographicCamera) {
  Camera flat = camera;
  flat.orthographic = true;
  flat.ymag = 4.0;
  flat.near_plane = 0.1;
  flat.far_plane = 40.0;
  const Shot shot = shoot(tangle(82, 300), flat, {sun(130, 35)}, exact);
  EXPECT_GT(expect_probes_are_the_mask(shot), 100u);
  expect_frusta_hold_the_receivers(shot.snapshot);
}

TEST(ViewSnapshot, ProbesAreTheMaskAtOneSample) {
  const Shot shot = shoot(tangle(83, 300), camera, {point_light({0.5, 3.0, 0.5})}, {{"spp", "1"}, {"grid", "128"}});
  expect_probes_are_the_mask(shot);
  EXPECT_GT(std::count(shot.snapshot.mask.begin(), shot.snapshot.mask.end(), ~0u), 50);
  EXPECT_EQ(available(shot.snapshot) & Need::micro_quads, 0u);
  expect_lists_agree(shot.snapshot);
  expect_frusta_hold_the_receivers(shot.snapshot);
}

// A frame of two lights leaves the second one's lists; the first one's are asked for all the same.
TEST(ViewSnapshot, IsOfTheLightThatIsAskedFor) {
  const Scene scene = tangle(84, 300);
  const std::vector<Light> lights{sun(130, 35), spot({2.0, 6.0, 3.0}, {0, 0, 0}, 40)};
  const Settings settings{{"spp", "32"}, {"grid", "128"}};
  std::vector<Snapshot> alone;
  for (const Light& light : lights) alone.push_back(shoot(scene, camera, {light}, settings).snapshot);
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set_options(*technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(*technique, width_px, height_px, lights);
  gpu::StageTimers timers(true);
  renderer.render(camera, lights, timers);
  for (const size_t light : {0u, 1u, 0u}) {
    const Snapshot s = take_snapshot(renderer, *technique, camera, light, ~0u);
    EXPECT_EQ(s.mask, alone[light].mask) << light;
    EXPECT_EQ(s.list_length, alone[light].list_length) << light;
    EXPECT_EQ(s.built->lists.nodes.size(), alone[light].built->lists.nodes.size()) << light;
    // What is removed when depends on the order of threads.
    EXPECT_NEAR(double(s.left->lists.nodes.size()), double(alone[light].left->lists.nodes.size()), 20.0) << light;
    ASSERT_EQ(s.windows.size(), 1u);
    EXPECT_EQ(s.windows[0].window, alone[light].windows[0].window) << light;
  }
}

TEST(ViewSnapshot, LeftLacksWhatBecameAllShadow) {
  Scene scene = tangle(86, 50);
  for (int layer = 0; layer < 6; ++layer)
    add_soup(scene, rectangle({-6, 3.0f + 0.1f * float(layer), -6}, {0, 0, 12}, {12, 0, 0}));
  const Snapshot s = shoot(scene, look_at({4.0, 2.0, 5.0}, {0, 0, 0}, glm::radians(50.0)), {sun(130, 60)},
                           {{"spp", "32"}, {"grid", "128"}})
                         .snapshot;
  EXPECT_LT(s.left->lists.nodes.size(), s.built->lists.nodes.size() * 9 / 10);
  size_t longest = 0;
  for (size_t i = 0; i < s.built->lists.count(); ++i) longest = std::max(longest, s.built->lists[i].size());
  EXPECT_EQ(*std::max_element(s.list_length.begin(), s.list_length.end()), float(longest));
  // What is left of a texel's list is a part of it.
  for (size_t i = 0; i < s.built->lists.count(); ++i)
    for (const uint32_t node : s.left->lists[i]) {
      const std::span<const uint32_t> list = s.built->lists[i];
      EXPECT_NE(std::find(list.begin(), list.end(), node), list.end());
    }
}

TEST(ViewSnapshot, SurfacesAreThoseOfTheScene) {
  Scene scene = empty_scene();
  scene.materials[0].base_color = glm::vec4(0.2f, 0.4f, 0.8f, 1.0f);
  add_soup(scene, floor_of(100.0f));
  scene.meshes[0].normals.assign(scene.meshes[0].positions.size(), glm::normalize(glm::vec3(0.6f, 0.8f, 0)));
  const Snapshot s = shoot(scene, camera, {sun(130, 60)}, {{"spp", "32"}, {"grid", "128"}}).snapshot;
  const size_t i = s.index({width_px / 2, height_px - 1});
  EXPECT_NEAR(s.albedo[i].x, 0.2f, 0.01f);
  EXPECT_NEAR(s.albedo[i].z, 0.8f, 0.01f);
  const glm::dvec3 n = glm::dmat3(s.camera_ws.world_from_view) * glm::dvec3(s.shading_normal[i]);
  EXPECT_NEAR(n.x, 0.6, 0.001);
  EXPECT_NEAR(n.y, 0.8, 0.001);
}

TEST(ViewSnapshot, EveryLookThatNeedsNoOtherFrameCanBePainted) {
  const Snapshot s = shoot(tangle(85, 100), camera, {sun(130, 35)}, {{"spp", "32"}, {"grid", "128"}}).snapshot;
  constexpr unsigned of_others = Need::truth | Need::tests | Need::fragments;
  EXPECT_EQ(available(s) | of_others, 0xfffu);
  for (const Look& look : looks())
    if ((look.needs & of_others) == 0) {
      EXPECT_NO_THROW(paint(look, s, 0)) << look.name;
    }
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// Stages `build` and `zcull` of the technique `izb`, each alone against the same computed on the CPU; and what the
// order of insertion may change.
#include <algorithm>
#include <array>
#include <set>

#include "gl/frame_fixture.h"
#include "shadow/izb/izb.h"
#include "shared/faces.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));

std::vector<Light> lights() {
  return {sun(130, 35), sun(20, 60), spot({1, 5, 2}, {0, 0, 0}, 55), point_light({0.4, 1.7, 0.9})};
}

/// Where a node stands, and which.
struct Place {
  glm::ivec2 texel;
  int layer, slot;
};

/// A frame and its irregular z-buffer.
struct Built {
  Frame frame;
  IzbInternals izb;

  Built(const Scene& scene, const Light& light, const Settings& settings, int stride = 1) {
    Izb technique;
    technique.settings().insertion_stride = stride;
    frame = render_frame(scene, camera, light, width_px, height_px, settings, technique);
    izb = technique.internals();
  }

  const shared::LightFrame& light() const { return frame.inputs.light; }
  bool receiver(size_t i) const { return frame.receivers.classes[i] == reference::PixelClass::receiver; }
  int cascades() const { return int(light().grid.y); }
  /// The face through which the light sees the pixel's centre.
  int face(size_t i) const {
    if (light().grid.z == 1) return 0;
    return shared::face_of(shared::light_position(light(), frame.receivers.points_vs[i]));
  }
  int layer_at(size_t i, int face) const {
    return face * cascades() + shared::cascade_of(frame.range, cascades(), frame.gbuffer.eye_distance[i]);
  }
  int layer(size_t i) const { return layer_at(i, face(i)); }
  shared::LightFrame face_light(size_t i) const { return shared::light_face(light(), face(i)); }
  const shared::LightWindow& window(size_t i) const { return frame.windows[size_t(layer(i))]; }
  /// Whether that face sees all of the micro-quad.
  bool whole(size_t i) const { return light().grid.z == 1 || shared::quad_part(light(), quad(i), face(i)).whole; }
  /// Of a pixel in the frame's images, top row first.
  static size_t index(uint32_t node) {
    const glm::ivec2 px = shared::pixel_from_node(node);
    return size_t(height_px - 1 - px.y) * width_px + px.x;
  }

  /// Grid position and depth of a pixel's centre.
  glm::vec3 position(size_t i) const {
    return shared::grid_position(
        window(i), shared::light_uvd(light(), shared::light_position(face_light(i), frame.receivers.points_vs[i])));
  }
  shared::MicroQuad quad(size_t i) const {
    return shared::make_micro_quad(frame.inputs.camera, glm::ivec2(frame.gbuffer.center_px(i)),
                                   frame.gbuffer.micro_quad[i]);
  }
  shared::QuadPart part(size_t i, int face) const {
    return light().grid.z == 1 ? shared::whole_quad(light(), quad(i)) : shared::quad_part(light(), quad(i), face);
  }
  /// Texels by which its points may be off.
  float guard(size_t i) const { return shared::quad_guard(window(i), part(i, layer(i) / cascades())); }
  glm::vec3 grid_position(size_t i, const glm::vec2& offset_px) const {
    return shared::grid_position(window(i), shared::micro_quad_uvd(face_light(i), quad(i), offset_px));
  }
  glm::ivec2 texel(size_t i, const glm::vec2& offset_px) const {
    return shared::grid_texel(window(i), grid_position(i, offset_px));
  }
  /// Depth of the pixel's node in that layer as `furthest` counts it.
  float depth(size_t i, int layer) const {
    if (frame.gbuffer.micro_quad.empty()) return position(i).z + window(i).depth.z;
    const int f = layer / cascades();
    const shared::LightFrame its = shared::light_face(light(), f);
    return shared::part_on_grid(its, frame.windows[size_t(layer)], quad(i), part(i, f)).deepest;
  }

  /// Visits (at, layer, list) for each texel of each grid.
  template <typename Visit>
  void for_each_texel(Visit&& visit) const {
    for (int layer = 0; layer < izb.layers; ++layer)
      for (int y = 0; y < izb.grid; ++y)
        for (int x = 0; x < izb.grid; ++x) visit(glm::ivec2(x, y), layer, izb.lists[izb.texel({x, y}, layer)]);
  }

  /// Where each pixel's nodes stand, by slot, then by texel.
  std::vector<std::vector<Place>> places() const {
    std::vector<std::vector<Place>> all(frame.mask.size());
    for_each_texel([&](const glm::ivec2& at, int layer, std::span<const uint32_t> list) {
      for (const uint32_t node : list) all[index(node)].push_back({at, layer, shared::slot_from_node(node)});
    });
    for (std::vector<Place>& places : all)
      std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.slot < b.slot; });
    return all;
  }
};

/// How far a grid position lies outside a texel, along the worse axis.
float outside(const glm::vec2& position, const glm::ivec2& texel) {
  const glm::vec2 low(texel), beyond = glm::max(glm::max(low - position, position - (low + 1.0f)), glm::vec2(0.0f));
  return std::max(beyond.x, beyond.y);
}

TEST(IzbBuild, EachReceiverStandsInTheListOfItsTexelAndNowhereElse) {
  const Scene scene = tangle(100, 200);
  for (const Light& light : lights())
    for (const Settings& settings : {Settings{{"grid", "16"}}, Settings{{"grid", "257"}}, Settings{{"grid", "1024"}},
                                     Settings{{"grid", "256"}, {"cascades", "4"}}}) {
      const Built built(scene, light, settings);
      const std::vector<std::vector<Place>> places = built.places();
      size_t nodes = 0, elsewhere = 0;
      for (size_t i = 0; i < places.size(); ++i) {
        ASSERT_EQ(places[i].size(), built.receiver(i) ? 1u : 0u) << i;
        if (places[i].empty()) continue;
        const Place& place = places[i][0];
        ASSERT_EQ(place.layer, built.layer(i)) << i;
        ++nodes;
        if (place.texel == shared::grid_texel(built.window(i), built.position(i))) continue;
        // The shader's sums and divisions may round in another way, each within the guard.
        ++elsewhere;
        EXPECT_LE(outside(built.position(i), place.texel), 2.0f * built.window(i).guard.x) << i;
      }
      EXPECT_GT(nodes, 1000u);
      EXPECT_LE(elsewhere, nodes / 200);
    }
}

/// Expects each texel's furthest depth to be that of its list.
void expect_furthest(const Built& built) {
  size_t lists = 0;
  built.for_each_texel([&](const glm::ivec2& at, int layer, std::span<const uint32_t> list) {
    const float furthest = built.izb.furthest[built.izb.texel(at, layer)];
    float expected = 0.0f;
    for (const uint32_t node : list) expected = std::max(expected, built.depth(Built::index(node), layer));
    lists += !list.empty();
    // Sums may round in another way, but by less than the guard, so that one that is missing shows.
    ASSERT_NEAR(furthest, expected, list.empty() ? 0.0f : 8.0f * shared::unit_roundoff)
        << at.x << " " << at.y << " " << layer;
  });
  EXPECT_GT(lists, 100u);
}

TEST(IzbBuild, TheFurthestDepthIsThatOfTheList) {
  const Scene scene = tangle(101, 200);
  for (const Light& light : lights())
    for (const Settings& settings : {Settings{{"grid", "64"}}, Settings{{"grid", "256"}, {"cascades", "3"}},
                                     Settings{{"grid", "64"}, {"spp", "32"}}})
      expect_furthest(Built(scene, light, settings));
  for (const Light& light : {lights()[0], lights()[3]})
    expect_furthest(Built(scene, light, {{"grid", "64"}, {"spp", "32"}, {"insertion", "exact"}}));
}

/// Texels of points of the micro-quad, each once.
std::vector<glm::ivec2> texels_at(const Built& built, size_t i, const std::vector<glm::vec2>& offsets_px, int most) {
  std::vector<glm::ivec2> texels;
  for (const glm::vec2& o : offsets_px) {
    const glm::ivec2 texel = built.texel(i, o);
    if (int(texels.size()) < most && std::find(texels.begin(), texels.end(), texel) == texels.end())
      texels.push_back(texel);
  }
  return texels;
}

glm::vec2 view_axis(const Built& built, size_t i) {
  const glm::vec2 slope(built.frame.gbuffer.micro_quad[i].y, built.frame.gbuffer.micro_quad[i].z);
  const float steepest = std::max(std::abs(slope.x), std::abs(slope.y));
  return steepest > 0.0f ? slope / (2.0f * steepest) : glm::vec2(0.5f, 0.0f);
}

/// Those of `count` points of the micro-quad along the view ray.
std::vector<glm::ivec2> texels_along_view(const Built& built, size_t i, int count) {
  const glm::vec2 axis = view_axis(built, i);
  std::vector<glm::vec2> offsets;
  for (int k = 0; k < count; ++k) offsets.push_back(axis * ((2.0f * float(k) + 1.0f) / float(count) - 1.0f));
  return texels_at(built, i, offsets, count);
}

/// Those that answer for the whole micro-quad, or what there is room for.
std::vector<glm::ivec2> covering_texels(const Built& built, size_t i, int most) {
  const shared::Cover cover =
      shared::make_cover(shared::project_quad(built.face_light(i), built.window(i), built.quad(i)), 1.0f,
                         built.guard(i) + 0.001f, shared::last_texel(built.window(i)), most);
  const glm::vec2 axis = view_axis(built, i);
  const glm::vec3 ends = glm::abs(built.grid_position(i, axis) - built.grid_position(i, -axis));
  if (cover.rows.count < cover.rows.needed && std::max(ends.x, ends.y) > 0.5f * cover.long_side)
    return texels_along_view(built, i, most);
  std::vector<glm::ivec2> texels;
  for (int r = 0; r < cover.rows.count; ++r) {
    const int row = shared::run_texel(cover.rows, r, cover.last);
    const shared::Run columns = shared::cover_row(cover, row, most - int(texels.size()) - (cover.rows.count - 1 - r));
    for (int k = 0; k < columns.count; ++k) texels.push_back(shared::cover_texel(cover, row, columns, k));
  }
  return texels;
}

/// The texels of a pixel's nodes in the order of its slots (6.1).
std::vector<glm::ivec2> expected_texels(const Built& built, size_t i, const std::string& insertion, int most) {
  if (insertion == "samples") return texels_at(built, i, built.frame.inputs.samples.offsets_px, most);
  if (insertion == "approximate") return covering_texels(built, i, most);
  const glm::vec3 normal = glm::normalize(shared::octahedral_direction(built.frame.gbuffer.normal[i]));
  const float facing = std::abs(glm::dot(normal, glm::normalize(built.quad(i).center)));
  return texels_along_view(built, i, std::clamp(int(std::ceil(1.0f / std::max(facing, 0.0001f))), 1, most));
}

TEST(IzbBuild, ApproximateInsertionPutsNodesWhereItSays) {
  const Scene scene = tangle(102, 200);
  const std::pair<std::string, int> ways[] = {{"approximate", 8}, {"approximate", 3}, {"nv", 8}, {"samples", 8}};
  for (const auto& [insertion, most] : ways)
    for (const Light& light : {lights()[0], lights()[2], lights()[3]}) {
      const Built built(scene, light,
                        {{"spp", "32"},
                         {"grid", "512"},
                         {"grid-density", "0"},
                         {"cascades", "2"},
                         {"insertion", insertion},
                         {"nodes", std::to_string(most)}});
      const std::vector<std::vector<Place>> places = built.places();
      size_t pixels = 0, nodes = 0, elsewhere = 0, across = 0;
      for (size_t i = 0; i < places.size(); ++i) {
        if (!built.receiver(i)) {
          ASSERT_TRUE(places[i].empty()) << i;
          continue;
        }
        if (!built.whole(i)) {
          ++across;
          continue;
        }
        std::vector<glm::ivec2> texels;
        for (const Place& place : places[i]) {
          ASSERT_EQ(place.layer, built.layer(i)) << i;
          ASSERT_EQ(place.slot, int(texels.size())) << i;
          ASSERT_EQ(std::count(texels.begin(), texels.end(), place.texel), 0) << i;
          texels.push_back(place.texel);
        }
        ++pixels;
        nodes += texels.size();
        elsewhere += texels != expected_texels(built, i, insertion, most);
        // Whoever could take one more node answers for every sample.
        if (insertion != "approximate" || int(texels.size()) == most) continue;
        for (const glm::vec2& o : built.frame.inputs.samples.offsets_px) {
          const glm::vec2 p(built.grid_position(i, o));
          EXPECT_TRUE(std::any_of(texels.begin(), texels.end(), [&](const glm::ivec2& texel) {
            const glm::vec2 d = glm::abs(p - (glm::vec2(texel) + 0.5f));
            return std::max(d.x, d.y) <= 1.0f + built.guard(i);
          })) << i;
        }
      }
      EXPECT_GT(pixels, 1000u);
      EXPECT_LT(across, 300u);
      EXPECT_GT(nodes, 2 * pixels);
      EXPECT_LE(elsewhere, pixels / 200) << insertion;  // where a length or a position lies within rounding of a whole
    }
}

/// The corners of a micro-quad that one face sees all of on the grid, in double.
std::array<glm::dvec2, 4> corners_in_double(const Built& built, size_t i) {
  const shared::LightFrame light = built.face_light(i);
  const shared::MicroQuad quad = built.quad(i);
  const auto along = [&](const glm::vec4& axis, const glm::dvec3& p) {
    return glm::dot(glm::dvec3(glm::vec3(axis)), p - glm::dvec3(glm::vec3(light.origin)));
  };
  std::array<glm::dvec2, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec3 p = point_in_double(quad, shared::corner_offset(k));
    const double z = shared::is_positional(light) ? along(light.axis_z, p) : 1.0;
    const glm::vec4 window = built.window(i).window;
    corners[size_t(k)] = {(along(light.axis_x, p) / z - window.x) * window.z,
                          (along(light.axis_y, p) / z - window.y) * window.w};
  }
  return corners;
}

/// Whether a convex quad meets the square of a texel, `grow` texels larger on each side: no axis separates them.
bool meets(const std::array<glm::dvec2, 4>& quad, const glm::ivec2& texel, double grow) {
  std::vector<glm::dvec2> axes{{1, 0}, {0, 1}};
  for (size_t k = 0; k < 4; ++k) {
    const glm::dvec2 side = quad[(k + 1) % 4] - quad[k];
    axes.emplace_back(-side.y, side.x);
  }
  return std::all_of(axes.begin(), axes.end(), [&](const glm::dvec2& axis) {
    double low = 1e300, high = -1e300;
    for (const glm::dvec2& corner : quad) {
      const double along = glm::dot(axis, corner - (glm::dvec2(texel) + 0.5));
      low = std::min(low, along), high = std::max(high, along);
    }
    const double reach = (0.5 + grow) * (std::abs(axis.x) + std::abs(axis.y));
    return low <= reach && high >= -reach;
  });
}

/// Expects points of a micro-quad that several faces see each to stand in the texel where its face sees it.
void expect_points_in(const Built& built, size_t i, const std::set<std::array<int, 3>>& texels) {
  const shared::MicroQuad quad = built.quad(i);
  Random random(static_cast<uint32_t>(i));
  for (int k = 0; k < 200; ++k) {
    const glm::dvec2 o(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    const glm::dvec3 p = point_in_double(quad, o);
    const int f = shared::face_of(shared::light_position(built.light(), glm::vec3(p)));
    const shared::LightFrame face = shared::light_face(built.light(), f);
    const int layer = built.layer_at(i, f);
    const glm::vec4 window = built.frame.windows[size_t(layer)].window;
    const auto along = [&](const glm::vec4& axis) {
      return glm::dot(glm::dvec3(glm::vec3(axis)), p - glm::dvec3(glm::vec3(face.origin)));
    };
    const double z = along(face.axis_z);
    const glm::dvec2 at((along(face.axis_x) / z - window.x) * window.z, (along(face.axis_y) / z - window.y) * window.w);
    const glm::ivec2 texel =
        glm::clamp(glm::ivec2(glm::floor(at)), 0, shared::last_texel(built.frame.windows[size_t(layer)]));
    ASSERT_TRUE(texels.contains({texel.x, texel.y, layer})) << i << ": " << texel.x << " " << texel.y << " " << f;
  }
}

TEST(IzbBuild, ExactInsertionPutsANodeIntoEachTexelThatTheMicroQuadTouchesAndIntoNoneAway) {
  const Scene scene = tangle(103, 200);
  for (const Light& light : {lights()[0], lights()[2], lights()[3]}) {
    const Built built(scene, light, {{"spp", "32"}, {"insertion", "exact"}, {"grid", "256"}, {"cascades", "2"}});
    const std::vector<std::vector<Place>> places = built.places();
    size_t nodes = 0, touched = 0, across = 0;
    for (size_t i = 0; i < places.size(); ++i) {
      if (!built.receiver(i)) {
        ASSERT_TRUE(places[i].empty()) << i;
        continue;
      }
      std::set<std::array<int, 3>> texels;
      for (const Place& place : places[i])
        ASSERT_TRUE(texels.insert({place.texel.x, place.texel.y, place.layer}).second) << "twice in one list: " << i;
      if (!built.whole(i)) {
        ++across;
        expect_points_in(built, i, texels);
        continue;
      }
      const std::array<glm::dvec2, 4> quad = corners_in_double(built, i);
      for (const Place& place : places[i]) {
        ASSERT_EQ(place.layer, built.layer(i)) << i;
        ASSERT_TRUE(meets(quad, place.texel, double(built.guard(i)) + 0.002)) << i;
      }
      glm::dvec2 low = quad[0], high = quad[0];
      for (const glm::dvec2& corner : quad) low = glm::min(low, corner), high = glm::max(high, corner);
      for (int y = int(std::floor(low.y)); y <= int(std::floor(high.y)); ++y)
        for (int x = int(std::floor(low.x)); x <= int(std::floor(high.x)); ++x)
          if (meets(quad, {x, y}, 0.0)) {
            ASSERT_TRUE(texels.contains({x, y, built.layer(i)})) << i << ": " << x << " " << y;
            ++touched;
          }
      nodes += texels.size();
    }
    EXPECT_GT(touched, 5000u);
    // A positional light's guard is several texels wide here, and all of those get nodes.
    if (light.type == LightType::directional) {
      EXPECT_LT(nodes, touched * 11 / 10);
    } else {
      EXPECT_GT(across, 20u);
      EXPECT_LT(across, 400u);
    }
  }
}

const std::vector<Settings> zcull_settings{
    {{"grid", "64"}}, {{"grid", "250"}, {"cascades", "3"}}, {{"grid", "1024"}}, {{"grid", "64"}, {"spp", "32"}}};

TEST(IzbZCull, TheDepthBufferIsTheFurthestDepthRoundedUpByOneToTwoSteps) {
  const Scene scene = tangle(104, 200);
  for (const Settings& settings : zcull_settings) {
    const IzbInternals izb = Built(scene, lights()[0], settings).izb;
    ASSERT_EQ(izb.zcull.size(), izb.furthest.size());
    size_t lists = 0;
    for (size_t i = 0; i < izb.furthest.size(); ++i) {
      if (izb.furthest[i] == 0.0f) {
        ASSERT_EQ(izb.zcull[i], 0u) << i;
        continue;
      }
      ++lists;
      const double steps = izb.zcull[i] - 65535.0 * double(izb.furthest[i]), rounding = 0.01;
      ASSERT_GE(steps, 1.0 - rounding) << i;
      ASSERT_LE(steps, 2.0 + rounding) << i;
    }
    EXPECT_GT(lists, 100u);
  }
}

TEST(IzbZCull, EachTexelOfThePyramidIsTheFurthestOfItsSquare) {
  const Scene scene = tangle(105, 200);
  for (const Settings& settings : zcull_settings) {
    const IzbInternals izb = Built(scene, lights()[1], settings).izb;
    for (int level = 0; level < shared::pyramid_levels; ++level) {
      const int side = shared::pyramid_side(izb.grid, level), square = 4 << (2 * level);
      ASSERT_EQ(side, (izb.grid + square - 1) / square);
      std::vector<float> expected(size_t(side) * side * izb.layers, 0.0f);
      const auto at = [&](int x, int y, int layer) { return (size_t(layer) * side + y) * side + x; };
      for (int c = 0; c < izb.layers; ++c)
        for (int y = 0; y < izb.grid; ++y)
          for (int x = 0; x < izb.grid; ++x) {
            float& deepest = expected[at(x / square, y / square, c)];
            deepest = std::max(deepest, izb.furthest[izb.texel({x, y}, c)]);
          }
      for (int c = 0; c < izb.layers; ++c)
        for (int y = 0; y < side; ++y)
          for (int x = 0; x < side; ++x)
            ASSERT_EQ(izb.pyramid_at(level, {x, y}, c), expected[at(x, y, c)]) << level << ": " << x << " " << y;
    }
  }
}

/// Expects the same lists but for their order, and that this differs.
void expect_other_order(const IzbInternals& a, const IzbInternals& b) {
  ASSERT_EQ(a.lists.count(), b.lists.count());
  size_t several = 0, other_order = 0;
  for (size_t i = 0; i < a.lists.count(); ++i) {
    std::vector<uint32_t> one(a.lists[i].begin(), a.lists[i].end()), other(b.lists[i].begin(), b.lists[i].end());
    several += one.size() > 1;
    other_order += one != other;
    std::sort(one.begin(), one.end()), std::sort(other.begin(), other.end());
    ASSERT_EQ(one, other) << i;
  }
  EXPECT_GT(several, 100u);
  EXPECT_GT(other_order,
            several / 8);  // where threads run side by side, many lists keep theirs: on an H200 four fifths
}

// Coprime to the number of pixels: backwards, and scattered.
const int strides[] = {width_px * height_px - 1, 1001};

TEST(IzbOrder, OfInsertionAndDrawingDoesNotChangeTheBruteForceMask) {
  const Scene scene = tangle(106, 300);
  Scene backwards = scene;
  for (Mesh& mesh : backwards.meshes) std::reverse(mesh.indices.begin(), mesh.indices.end());
  std::swap(backwards.meshes[0], backwards.meshes[1]);
  for (const Light& light : lights())
    for (const Settings& settings :
         {Settings{{"grid", "128"}}, Settings{{"grid", "128"}, {"removal", "off"}, {"pipelining", "on"}}}) {
      const Built base(scene, light, settings);
      EXPECT_EQ(different(base.frame.mask, brute_force_mask(base.frame)), 0u);
      EXPECT_GT(shadowed(base.frame), 100u);
      for (const int stride : strides) {
        const Built permuted(scene, light, settings, stride);
        expect_other_order(base.izb, permuted.izb);
        EXPECT_EQ(different(base.frame.mask, permuted.frame.mask), 0u) << stride;
        const Built both(backwards, light, settings, stride);
        EXPECT_EQ(different(both.frame.mask, brute_force_mask(both.frame)), 0u) << stride;
      }
    }
}

TEST(IzbOrder, OfInsertionDoesNotChangeTheMaskOf32Samples) {
  const Scene scene = tangle(107, 300);
  const Settings exact{{"spp", "32"}, {"coverage", "exact"}, {"insertion", "exact"}, {"grid", "256"}};
  const Settings approximate{{"spp", "32"}, {"grid", "256"}};
  for (const Settings& settings : {exact, with(exact, {{"removal", "off"}}), approximate}) {
    const Built base(scene, lights()[0], settings);
    for (const int stride : strides) {
      const Built permuted(scene, lights()[0], settings, stride);
      expect_other_order(base.izb, permuted.izb);
      EXPECT_EQ(different(base.frame.mask, permuted.frame.mask), 0u) << stride;
    }
  }
}

}  // namespace
}  // namespace izb::test

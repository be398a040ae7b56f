// SPDX-License-Identifier: MIT
// Stage `build` of the technique `izb` alone against the same computed on the CPU: which pixel stands in which lists.
#include <array>
#include <set>

#include "gl/built.h"
#include "gl/edge_on_wall.h"

namespace izb::test {
namespace {

using namespace built;

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
  const EdgeOnWall wall = edge_on_wall({4.0f, 5.0f, 7.0f}, {0.0f, 0.6f, 0.0f});
  const std::pair<const Scene*, Light> cases[] = {
      {&scene, lights()[0]}, {&scene, lights()[2]}, {&scene, lights()[3]}, {&wall.with_wall, wall.lamp}};
  for (const auto& [of, light] : cases) {
    const Built built(*of, light, {{"spp", "32"}, {"insertion", "exact"}, {"grid", "256"}, {"cascades", "2"}});
    const std::vector<std::vector<Place>> places = built.places();
    size_t nodes = 0, touched = 0, across = 0, wide = 0;
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
      // The positions' error is far less than the bound on it, so half of it is surely granted.
      const double guard = built.guard(i), granted = 0.5 * guard;
      wide += guard > 0.5;
      glm::dvec2 low = quad[0], high = quad[0];
      for (const glm::dvec2& corner : quad) low = glm::min(low, corner), high = glm::max(high, corner);
      low = glm::max(low - granted, 0.0);
      high = glm::min(high + granted, double(shared::last_texel(built.window(i))));
      for (int y = int(std::floor(low.y)); y <= int(std::floor(high.y)); ++y)
        for (int x = int(std::floor(low.x)); x <= int(std::floor(high.x)); ++x)
          if (meets(quad, {x, y}, granted)) {
            ASSERT_TRUE(texels.contains({x, y, built.layer(i)})) << i << ": " << x << " " << y;
            ++touched;
          }
      nodes += texels.size();
    }
    EXPECT_GT(touched, 5000u);
    EXPECT_LT(nodes, touched * 11 / 10);
    if (light.type != LightType::directional) {
      EXPECT_GT(across, 20u);
      EXPECT_LT(across, 400u);
    }
    if (of == &wall.with_wall) {
      EXPECT_GT(wide, 10u);
    }
  }
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// Scenes whose shadow is known in closed form, crossed with every technique that casts exact hard shadows.
#include <algorithm>

#include "gl/frame_fixture.h"
#include "scene/shapes.h"

namespace izb::test {
namespace {

constexpr int width_px = 320, height_px = 240;
const char* const techniques[] = {"izb", "ray_traced"};

const Camera above = look_at({0.3, 9.0, 5.0}, {0, 0, 0}, glm::radians(45.0));

/// World position of each receiver.
glm::dvec3 world_point(const Frame& frame, const Camera& camera, size_t i) {
  return glm::dvec3(camera.world_from_view * glm::dvec4(glm::dvec3(frame.receivers.points_vs[i]), 1.0));
}

/// Points of a square of side 2 around the origin at height 2, cut into random triangles: a fine grid whose inner
/// vertices are moved at random, each cell split along a random diagonal; order shuffled.
std::vector<glm::vec3> cut_square(int cells, uint32_t seed) {
  Random random(seed);
  std::vector<glm::vec3> grid;
  for (int z = 0; z <= cells; ++z)
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && z > 0 && x < cells && z < cells;
      const double jitter = inner ? 0.3 : 0.0;
      grid.push_back(glm::vec3(2.0 * (x + random.uniform(-jitter, jitter)) / cells - 1.0, 2.0,
                               2.0 * (z + random.uniform(-jitter, jitter)) / cells - 1.0));
    }
  std::vector<std::array<glm::vec3, 3>> triangles;
  for (int z = 0; z < cells; ++z)
    for (int x = 0; x < cells; ++x) {
      const glm::vec3 a = grid[z * (cells + 1) + x], b = grid[z * (cells + 1) + x + 1];
      const glm::vec3 c = grid[(z + 1) * (cells + 1) + x + 1], d = grid[(z + 1) * (cells + 1) + x];
      if (random.below(2))
        triangles.insert(triangles.end(), {{a, b, c}, {c, d, a}});
      else
        triangles.insert(triangles.end(), {{b, c, d}, {d, a, b}});
    }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(seed));
  std::vector<glm::vec3> soup;
  for (const auto& t : triangles) soup.insert(soup.end(), t.begin(), t.end());
  return soup;
}

/// Is the floor point (x, z) in the square's shadow, by more than `margin` inside or outside? 1, 0, or -1: too close.
int square_shadow(const glm::dvec3& p, const Light& light, double margin) {
  glm::dvec3 on;
  if (light.type != LightType::directional) {
    on = glm::mix(p, light.position_ws, (2.0 - p.y) / (light.position_ws.y - p.y));
  } else {
    on = p + light.direction_ws * ((2.0 - p.y) / light.direction_ws.y);
  }
  const double reach = std::max(std::abs(on.x), std::abs(on.z)) - 1.0;
  return std::abs(reach) < margin ? -1 : reach < 0.0;
}

TEST(ClosedForm, ASquareOverAFloorWholeOrInManyTrianglesCastsTheSameKnownShadow) {
  for (const Light& light : {sun(135, 50), spot({0.4, 6.0, -0.3}, {0, 0, 0}, 50), point_light({0.4, 6.0, -0.3})})
    for (const int cells : {1, 224}) {  // 2 and 100,352 triangles
      Scene scene = empty_scene();
      add_soup(scene, floor_of(12.0f));
      add_soup(scene, cut_square(cells, 7));
      for (const char* technique : techniques) {
        const Frame frame = render_frame(scene, above, light, width_px, height_px, {}, technique);
        size_t inside = 0, wrong = 0, close = 0;
        for (size_t i = 0; i < frame.mask.size(); ++i) {
          const glm::dvec3 p = world_point(frame, above, i);
          if (frame.receivers.classes[i] != reference::PixelClass::receiver || std::abs(p.y) > 1e-3) continue;
          // 1/64 pixel at ten metres, and the doubles and floats of matrices and points.
          const int truth = square_shadow(p, light, 10.0 * double(frame.receivers.band[i]));
          close += truth < 0;
          inside += truth == 1;
          wrong += truth >= 0 && (frame.mask[i] != 0) != (truth == 1);
        }
        EXPECT_EQ(wrong, 0u) << technique << ", " << cells << " cells";
        expect_explained(frame);
        EXPECT_GT(inside, 900u);
        EXPECT_LT(close, 200u);
      }
    }
}

TEST(ClosedForm, CuttingTheSquareChangesNoBitButWithinTheBandOfItsOutline) {
  const Light light = sun(135, 50);
  Scene whole = empty_scene(), cut = empty_scene();
  for (Scene* scene : {&whole, &cut}) add_soup(*scene, floor_of(12.0f));
  add_soup(whole, cut_square(1, 8));
  add_soup(cut, cut_square(224, 8));
  const Frame a = render_frame(whole, above, light, width_px, height_px);
  const Frame b = render_frame(cut, above, light, width_px, height_px);
  for (size_t i = 0; i < a.mask.size(); ++i)
    if (a.mask[i] != b.mask[i]) {
      EXPECT_EQ(square_shadow(world_point(a, above, i), light, 2.0 * double(a.receivers.band[i])), -1) << i;
    }
  expect_explained(b);
}

TEST(ClosedForm, SamplesOnSharedEdgesAndVerticesOfACutSquareAreAllInItsShadow) {
  for (const Light& light : {sun(135, 50), spot({0.4, 6.0, -0.3}, {0, 0, 0}, 50), point_light({0.4, 6.0, -0.3})}) {
    Scene scene = empty_scene();
    add_soup(scene, floor_of(12.0f));
    const Frame bare = render_frame(scene, above, light, width_px, height_px);
    const auto up_to_square = [&](const glm::dvec3& p) {
      if (light.type != LightType::directional)
        return glm::mix(p, light.position_ws, (2.0 - p.y) / (light.position_ws.y - p.y));
      return p + light.direction_ws * ((2.0 - p.y) / light.direction_ws.y);
    };
    // Where the rays of some pixels meet the square's plane: each becomes the corner that four triangles of its cell
    // share. Its receiver lies on a vertex; that of every second one at a time on an edge, which ends at its mirror
    // image.
    constexpr int cells = 20;
    std::vector<std::vector<std::pair<size_t, glm::dvec3>>> hits(cells * cells);
    for (size_t i = 0; i < bare.mask.size(); ++i) {
      if (bare.receivers.classes[i] != reference::PixelClass::receiver) continue;
      const glm::dvec3 on = up_to_square(world_point(bare, above, i));
      const double x = (on.x + 1.0) * 0.5 * cells, z = (on.z + 1.0) * 0.5 * cells;
      if (!(x > 0 && z > 0 && x < cells && z < cells)) continue;
      const double fx = x - std::floor(x), fz = z - std::floor(z);
      if (std::min({fx, fz, 1.0 - fx, 1.0 - fz}) > 0.2) hits[size_t(z) * cells + size_t(x)].emplace_back(i, on);
    }
    std::vector<glm::vec3> soup;
    std::vector<size_t> placed;
    for (int z = 0; z < cells; ++z)
      for (int x = 0; x < cells; ++x) {
        const auto corner = [&](int dx, int dz) {
          return glm::vec3(2.0f * float(x + dx) / cells - 1.0f, 2.0f, 2.0f * float(z + dz) / cells - 1.0f);
        };
        const glm::vec3 rim[4] = {corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)};
        glm::vec3 hub = 0.5f * (rim[0] + rim[2]);
        if (const auto& here = hits[size_t(z) * cells + size_t(x)]; !here.empty()) {
          placed.push_back(here[0].first);
          hub = glm::vec3(here[0].second);
          if ((x + z) % 2) hub += 0.25f * (hub - rim[0]);  // then the ray meets the edge from rim[0] to the hub
        }
        for (int k = 0; k < 4; ++k) soup.insert(soup.end(), {hub, rim[k], rim[(k + 1) % 4]});
      }
    add_soup(scene, soup);
    EXPECT_GT(placed.size(), 150u);
    for (const char* technique : techniques) {
      const Frame frame = render_frame(scene, above, light, width_px, height_px, {}, technique);
      size_t compared = 0, leaks = 0;
      for (const size_t i : placed) {
        if (frame.receivers.own_triangle[i] != bare.receivers.own_triangle[i]) continue;  // the square hides it
        ++compared;
        leaks += frame.mask[i] == 0u;
      }
      EXPECT_GT(compared, 80u);
      // Embree's own edges are not exact: its mask is judged by the band alone.
      if (std::string(technique) == "izb") {
        EXPECT_EQ(leaks, 0u);
      }
      expect_explained(frame);
    }
  }
}

TEST(ClosedForm, AFlatFloorOfManyTrianglesHoweverTurnedAndItsDuplicatesHaveNoShadow) {
  Random random(9);
  for (int turn = 0; turn < 6; ++turn) {
    const glm::dmat4 world = glm::rotate(glm::dmat4(1.0), random.uniform(0, 6), random.direction()) *
                             glm::translate(glm::dmat4(1.0), random.point(3.0));
    Scene scene = empty_scene();
    add_soup(scene, floor_of(12.0f, 224), world);  // 100,352 triangles
    for (int copy = 0; copy < turn % 3; ++copy) add_soup(scene, floor_of(12.0f, copy ? 224 : 37), world);
    const glm::dvec3 up = glm::dvec3(world * glm::dvec4(0, 1, 0, 0)),
                     across = glm::dvec3(world * glm::dvec4(1, 0, 0, 0));
    const glm::dvec3 center = glm::dvec3(world * glm::dvec4(0, 0, 0, 1));
    const Camera camera = look_at(center + up * 4.0 + across * 7.0, center, glm::radians(50.0));
    Light light = sun(0, 0);
    light.direction_ws = -glm::normalize(up * (turn % 2 ? 0.05 : 1.0) + across);
    const Light lamp = spot(center + up * 2.0 + across * 2.0, center, 50.0);
    for (const Light& l : {light, lamp})
      for (const char* technique : techniques) {
        const Frame frame = render_frame(scene, camera, l, width_px, height_px, {}, technique);
        // The duplicates' rounded floats do shadow each other by an ulp, and rays, which have no bias, see that.
        if (std::string(technique) == "izb") {
          EXPECT_EQ(shadowed(frame), 0u) << technique << ", turn " << turn;
        }
        EXPECT_GT(receivers(frame), 3000u);
        expect_explained(frame);
      }
  }
}

TEST(ClosedForm, ASphereHasNoAcneAndItsTerminatorIsWhereTheTangentIs) {
  Scene scene = empty_scene();
  Mesh ball;
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 128; ++i) {
    const double angle = 3.14159265358979 * (i / 128.0 - 0.5);
    profile.emplace_back(i == 0 || i == 128 ? 0.0 : std::cos(angle), std::sin(angle));
  }
  shapes::add_lathe(ball, profile, 256);
  scene.meshes.push_back(ball);
  scene.instances.push_back({0, glm::dmat4(1.0)});
  const Camera camera = look_at({0, 0.4, 4}, {0, 0, 0}, glm::radians(35.0));
  for (const auto& [azimuth, technique] :
       {std::pair{10.0, "izb"}, {95.0, "izb"}, {170.0, "izb"}, {95.0, "ray_traced"}}) {
    const Light light = sun(azimuth, 25);
    const Frame frame = render_frame(scene, camera, light, width_px, height_px, {}, technique);
    size_t lit = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i) {
      if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
      const double cosine = glm::dot(world_point(frame, camera, i), -light.direction_ws);
      lit += cosine > 0.03;
      // A facet is 1.4 degrees wide: beyond that from the terminator a convex body does not shadow itself.
      if (cosine > 0.03) {
        EXPECT_EQ(frame.mask[i], 0u) << "acne at pixel " << i;
      }
    }
    EXPECT_GT(lit, 400u);
    expect_explained(frame);
  }
}

TEST(ClosedForm, ABoxOnAFloorLeavesNoGapAtItsFoot) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f));
  Mesh box;
  shapes::add_box(box, {-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0});
  scene.meshes.push_back(box);
  scene.instances.push_back({1, glm::dmat4(1.0)});
  const Light light = sun(-90, 45);  // from -x: the shadow lies on x in [1, 3]
  const Camera camera = look_at({5.0, 4.0, 3.0}, {1.0, 0, 0}, glm::radians(40.0));
  for (const char* technique : techniques) {
    const Frame frame = render_frame(scene, camera, light, width_px, height_px, {}, technique);
    size_t inside = 0, gap = 0;
    for (size_t i = 0; i < frame.mask.size(); ++i) {
      const glm::dvec3 p = world_point(frame, camera, i);
      if (frame.receivers.classes[i] != reference::PixelClass::receiver || std::abs(p.y) > 1e-4) continue;
      const double margin = 2.0 * double(frame.receivers.band[i]);
      if (std::abs(p.z) > 1.0 - margin || p.x < 1.0 + margin || p.x > 3.0 - margin) continue;
      ++inside;
      gap += frame.mask[i] == 0u;
    }
    EXPECT_GT(inside, 1000u);
    EXPECT_EQ(gap, 0u) << technique;
    expect_explained(frame);
  }
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// The triangle-point test that the GPU runs: single against double precision, and double against the exact predicate.
#include <gtest/gtest.h>

#include <algorithm>

#include "reference/exact.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

struct Case {
  shared::LightFrame light;
  glm::vec3 a, b, c, p;
  float eye_distance;
};

/// A triangle of any size and shape, and a point that lies behind it, often within rounding of one of its shadow's
/// edges or corners, or of its plane.
Case random_case(Random& random) {
  Case k;
  const double reach = std::pow(10.0, random.uniform(-2.0, 4.0));
  const double size = reach * std::pow(10.0, random.uniform(-5.0, 0.5));
  const glm::dvec3 position = random.point(reach);
  k.light = make_light(random.direction(), random.below(2) ? &position : nullptr);
  const glm::dvec3 center = random.point(reach);
  k.a = glm::vec3(center + random.point(size));
  k.b = glm::vec3(center + random.point(size));
  k.c = glm::vec3(center + random.point(size));
  if (random.below(4) == 0)
    k.c = glm::vec3(glm::dvec3(k.a) + 1e-3 * random.uniform(-1, 1) * glm::dvec3(k.b - k.a) + 1e-6 * random.point(size));

  const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
  glm::dvec3 weights(u, v, 1.0 - u - v);
  switch (random.below(4)) {
    case 0:
      weights = {0.0, u, 1.0 - u};
      break;  // on an edge
    case 1:
      weights = {0.0, 0.0, 1.0};
      break;  // on a corner
    case 2:
      weights = weights * 3.0 - 2.0 / 3.0;
      break;  // around it
    default:
      break;
  }
  const glm::dvec3 on = weights.x * glm::dvec3(k.a) + weights.y * glm::dvec3(k.b) + weights.z * glm::dvec3(k.c);
  const bool positional = shared::is_positional(k.light);
  const glm::dvec3 away =
      positional ? on - glm::dvec3(glm::vec3(k.light.origin)) : -glm::dvec3(glm::vec3(k.light.to_light));
  const double along =
      random.below(5) == 0 ? 0.0 : std::pow(10.0, random.uniform(-6.0, 1.0)) * (positional ? 1.0 : reach);
  k.p = glm::vec3(on + away * along);
  k.eye_distance = std::max(float(glm::length(glm::dvec3(k.p))) * 0.7f, 1e-6f);
  return k;
}

reference::LightPoint light_point(const shared::LightFrame& light) {
  const bool positional = shared::is_positional(light);
  return {positional ? glm::vec3(light.origin) : glm::vec3(light.to_light), positional};
}

TEST(SharedOcclusion, SinglePrecisionNeverContradictsDouble) {
  Random random(1);
  const shared::CameraFrame camera = perspective_camera();
  int in = 0, out = 0, unsure = 0, wrong = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    const Case k = random_case(random);
    const int answer = shared::classify(camera, shared::make_planes(k.light, k.a, k.b, k.c), k.p, k.eye_distance);
    const bool truth = shared::occludes(camera, k.light, k.a, k.b, k.c, k.p, k.eye_distance);
    in += answer == shared::pair_in;
    out += answer == shared::pair_out;
    unsure += answer == shared::pair_unsure;
    wrong += (answer == shared::pair_in && !truth) || (answer == shared::pair_out && truth);
  }
  EXPECT_EQ(wrong, 0);
  // Each answer is met often enough for the comparison to mean something.
  EXPECT_GT(in, 100'000);
  EXPECT_GT(out, 100'000);
  EXPECT_GT(unsure, 100'000);
}

TEST(SharedOcclusion, SinglePrecisionDecidesOrdinaryPairs) {
  Random random(2);
  const shared::CameraFrame camera = perspective_camera();
  int unsure = 0;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i) {
    // A hand-sized triangle within ten metres, a point within a metre of its shadow's axis.
    const shared::LightFrame light = make_light(random.direction(), nullptr);
    const glm::dvec3 center = glm::dvec3(0, 0, -12) + random.point(4.0);
    const glm::vec3 a(center + random.point(0.1)), b(center + random.point(0.1)), c(center + random.point(0.1));
    const glm::vec3 p(center - glm::dvec3(glm::vec3(light.to_light)) * random.uniform(0.2, 3.0) + random.point(0.1));
    unsure += shared::classify(camera, shared::make_planes(light, a, b, c), p, -p.z) == shared::pair_unsure;
  }
  EXPECT_LT(unsure, count / 500);
}

TEST(SharedOcclusion, DoublePrecisionIsTheExactPredicateButForThePlaneBias) {
  Random random(3);
  const shared::CameraFrame camera = perspective_camera();
  int shadowed = 0, wrong = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Case k = random_case(random);
    const bool ours = shared::occludes(camera, k.light, k.a, k.b, k.c, k.p, k.eye_distance);
    const reference::Corners corners{k.a, k.b, k.c};
    const bool exact = reference::occluded_exact(k.p, corners, light_point(k.light));
    shadowed += ours;
    if (ours == exact) continue;
    // Shadow that is not there is never right; a missing one only within the bias of the plane.
    const double bias = shared::plane_bias(camera, k.p, k.eye_distance, shared::max_norm1(k.a, k.b, k.c));
    const double height = reference::plane_distance(k.p, corners, light_point(k.light));
    wrong += ours || std::abs(height) > bias * 1.000001;
  }
  EXPECT_GT(shadowed, 20'000);
  // Double rounds, too: it may miss the exact sign for points placed on an edge to 1e-16.
  EXPECT_LE(wrong, 4);
}

TEST(SharedOcclusion, BiasIsAtMostAHundredTwentyEighthOfAPixelUnlessTheReceiverItselfIsCoarser) {
  Random random(4);
  const shared::CameraFrame camera = perspective_camera();
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 p = glm::vec3(random.point(100.0)) - glm::vec3(0, 0, 101);
    const float bias = shared::plane_bias(camera, p, -p.z, float(std::pow(10.0, random.uniform(-3, 7))));
    EXPECT_LE(bias,
              std::max(shared::pixel_width(camera, -p.z) / 128.0f, 4.0f * shared::unit_roundoff * shared::norm1(p)));
    EXPECT_GT(bias, 0.0f);
  }
}

TEST(SharedOcclusion, AFanLeavesNoGapAtSharedEdgesAndCorners) {
  Random random(5);
  const shared::CameraFrame camera = perspective_camera();
  for (int fan = 0; fan < 2'000; ++fan) {
    // Triangles around a corner, seen from the light as a disc; vertex order and winding vary.
    const glm::dvec3 position = random.direction() * 20.0;
    const bool positional = random.below(2) == 1;
    const glm::dvec3 way = positional ? -position : random.direction();
    const shared::LightFrame light = make_light(way, positional ? &position : nullptr);
    const glm::dvec3 x = glm::vec3(light.axis_x), y = glm::vec3(light.axis_y), z = glm::vec3(light.axis_z);
    const int count = 3 + int(random.below(6));
    const glm::vec3 hub(random.point(1.0));
    std::vector<glm::vec3> rim;
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307 * (i + random.uniform(0.3, 0.7)) / count;  // below 180 degrees apart
      rim.push_back(
          glm::vec3(glm::dvec3(hub) + x * std::cos(angle) + y * std::sin(angle) + z * random.uniform(-0.2, 0.2)));
    }
    for (int i = 0; i < 20; ++i) {
      const int spoke = int(random.below(uint32_t(count)));
      const double s = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 0.9);
      const glm::dvec3 on = glm::mix(glm::dvec3(hub), glm::dvec3(rim[spoke]), s);
      const glm::dvec3 away = positional ? on - glm::dvec3(glm::vec3(light.origin)) : z;
      const glm::vec3 p(on + away * random.uniform(0.1, 0.5));
      bool shadowed = false;
      for (int t = 0; t < count; ++t) {
        glm::vec3 corner[3] = {hub, rim[t], rim[(t + 1) % count]};
        if (t % 2) std::swap(corner[0], corner[2]);
        std::rotate(corner, corner + t % 3, corner + 3);
        shadowed |= shared::occludes(camera, light, corner[0], corner[1], corner[2], p, 10.0f);
      }
      EXPECT_TRUE(shadowed) << "fan " << fan << ", spoke " << spoke << ", at " << s;
    }
  }
}

TEST(SharedOcclusion, DegenerateAndEdgeOnTrianglesCastNothing) {
  const shared::CameraFrame camera = perspective_camera();
  const shared::LightFrame light = make_light({0, -1, 0}, nullptr);
  const glm::vec3 a(-1, 1, -5), b(1, 1, -5), c(0, 2, -5), p(0, 0, -5);
  EXPECT_FALSE(shared::occludes(camera, light, a, b, b, p, 5.0f));
  EXPECT_FALSE(shared::occludes(camera, light, a, b, c, p, 5.0f));  // its plane holds the light's direction
  EXPECT_TRUE(shared::occludes(camera, light, a, b, glm::vec3(0, 1, -7), p, 5.0f));
}

TEST(SharedOcclusion, AHugeTriangleIsNeverCalledOut) {
  // The square of its normal overflows: the plane's side must then be left to double precision.
  const shared::CameraFrame camera = perspective_camera();
  const shared::LightFrame light = make_light({0, -1, 0}, nullptr);
  for (const float size : {1.0e3f, 1.0e9f, 1.0e10f, 1.0e12f}) {
    // Ten sizes away, where the bias exceeds the rounding of a height: a plane of zeros would pass for one below it.
    const float z = -10.0f * size;
    const glm::vec3 a(-size, size, z - size), b(size, size, z - size), c(0, size, z + size), p(0, 0, z);
    ASSERT_TRUE(shared::occludes(camera, light, a, b, c, p, -z)) << size;
    EXPECT_NE(shared::classify(camera, shared::make_planes(light, a, b, c), p, -z), shared::pair_out) << size;
  }
}

TEST(SharedOcclusion, APlaneThatHoldsTheLightCastsNothingHereAndInTheTruth) {
  Random random(97);
  const glm::dvec3 lamp(0.5, 1.0, -10.0);
  int holding = 0, close = 0;
  for (int i = 0; i < 20000; ++i) {
    shared::LightFrame light = make_light(random.direction(), &lamp);
    light.axis_x.w = i % 2 == 0 ? 0.0f : 1e-3f;
    const reference::LightPoint point{glm::vec3(light.origin), true, light.axis_x.w};
    const glm::dvec3 n = random.direction();
    const double off = std::pow(10.0, random.uniform(-8.0, -1.0));
    const auto on_plane = [&] {
      const glm::dvec3 p = random.point(6.0);
      return glm::vec3(lamp + p - n * glm::dot(n, p) + n * off);
    };
    const glm::vec3 a = on_plane(), b = on_plane(), c = on_plane();
    const bool ours = shared::holds_light(light, a, b, c);
    const double band = light.axis_x.w + 16.0 * 0x1p-24 * shared::max_norm1(a, b, c);
    EXPECT_EQ(ours, reference::holds_light({a, b, c}, point)) << i;
    // The plane itself is off by its vertices' rounding, which a needle magnifies.
    const glm::dvec3 e1 = glm::normalize(glm::dvec3(b) - glm::dvec3(a)),
                     e2 = glm::normalize(glm::dvec3(c) - glm::dvec3(a));
    if (glm::length(glm::cross(e1, e2)) < 0.3) continue;
    if (off < 0.3 * band) {
      EXPECT_TRUE(ours) << i;
    }
    if (off > 3.0 * band + 1e-5) {
      EXPECT_FALSE(ours) << i;
    }
    holding += ours, close += !ours && off < 10.0 * band;
    if (ours) {
      const glm::vec3 inside = (a + b + c) / 3.0f;
      const glm::vec3 behind(lamp + (glm::dvec3(inside) - lamp) * 2.0 + n * off);
      const shared::CameraFrame camera = perspective_camera();
      EXPECT_FALSE(shared::occludes(camera, light, a, b, c, behind, 10.0f)) << i;
      EXPECT_FALSE(reference::occluded_exact(glm::dvec3(behind), {a, b, c}, point)) << i;
    }
  }
  EXPECT_GT(holding, 3000);
  EXPECT_GT(close, 500);
}

TEST(SharedOcclusion, ASpotIsNotShadowedFromBehindOrBeyond) {
  const shared::CameraFrame camera = perspective_camera();
  const glm::dvec3 lamp(0, 3, -10);
  const shared::LightFrame light = make_light({0, -1, 0}, &lamp);
  const glm::vec3 p(0, 0, -10);
  const auto roof = [&](float y) {
    return shared::occludes(camera, light, {-1, y, -11}, {1, y, -11}, {0, y, -8}, p, 10.0f);
  };
  EXPECT_TRUE(roof(1.0f));
  EXPECT_TRUE(roof(2.999f));
  EXPECT_FALSE(roof(3.001f));  // behind the lamp
  EXPECT_FALSE(roof(9.0f));
  EXPECT_FALSE(roof(-1.0f));  // beyond the receiver
}

}  // namespace
}  // namespace izb::test

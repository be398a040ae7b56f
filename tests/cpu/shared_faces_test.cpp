// SPDX-License-Identifier: MIT
// The cube around a light: its faces are the light's own space turned, and a micro-quad goes into each that sees it.
#include "shared/faces.h"

#include <gtest/gtest.h>

#include "shared/gbuffer.h"
#include "shared_fixture.h"

namespace izb::test {
namespace {

glm::dvec3 in_light_space(const shared::LightFrame& light, const glm::dvec3& p_vs) {
  const glm::dvec3 p = p_vs - glm::dvec3(glm::vec3(light.origin));
  return {glm::dot(glm::dvec3(glm::vec3(light.axis_x)), p), glm::dot(glm::dvec3(glm::vec3(light.axis_y)), p),
          glm::dot(glm::dvec3(glm::vec3(light.axis_z)), p)};
}

TEST(SharedFaces, EachIsTheSameSpaceTurnedAndSeesItsOwnPointsInItsPyramid) {
  Random random(120);
  const glm::dvec3 lamp(1.0, -2.0, -8.0);
  int seen[shared::cube_faces] = {};
  for (int i = 0; i < 2000; ++i) {
    const shared::LightFrame light = make_light(random.direction(), &lamp);
    const glm::vec3 p(lamp + random.point(5.0));
    const glm::vec3 p_ls = shared::light_position(light, p);
    for (int f = 0; f < shared::cube_faces; ++f) {
      const shared::LightFrame face = shared::light_face(light, f);
      EXPECT_EQ(shared::light_position(face, p), shared::on_face(p_ls, f)) << f;
      const glm::vec3 x(face.axis_x), y(face.axis_y), z(face.axis_z);
      EXPECT_GT(glm::dot(glm::cross(x, y), z), 0.999f) << f;  // turned, not mirrored
    }
    const int home = shared::face_of(p_ls);
    ++seen[home];
    const glm::vec3 there = shared::on_face(p_ls, home);
    EXPECT_GE(there.z, std::max(std::abs(there.x), std::abs(there.y)));
  }
  for (const int n : seen) EXPECT_GT(n, 100);
}

/// A micro-quad somewhere around a light that is near to it, or in it, compared with its size.
struct NearLight {
  shared::MicroQuad quad;
  shared::LightFrame light;

  explicit NearLight(Random& random) {
    const shared::CameraFrame camera = perspective_camera();
    const glm::vec3 at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-6.0, -2.0));
    const glm::vec3 u(random.direction()), v(random.direction());
    const glm::ivec2 px(random.below(1920), random.below(1080));
    const glm::vec3 a = at, b = at + u, c = at + v;
    const shared::ReceiverPlane plane = shared::intersect_plane(camera, glm::vec2(px) + 0.5f, a, b, c);
    const float t = plane.eye_distance > 0.5f && plane.eye_distance < 20.0f ? plane.eye_distance : 4.0f;
    quad = shared::make_micro_quad(camera, px, shared::micro_quad_data(camera, glm::vec2(px) + 0.5f, t, a, b, c));
    const double away = std::pow(10.0, random.uniform(-2.0, 3.0)) * double(quad.extent);
    const glm::dvec3 lamp = glm::dvec3(quad.center) + away * random.direction();
    light = make_light(random.direction(), &lamp);
  }
};

TEST(SharedFaces, EveryPointOfAMicroQuadLiesInThePartOfItsFace) {
  Random random(121);
  int whole = 0, several = 0, everywhere = 0;
  for (int i = 0; i < 20000; ++i) {
    const NearLight n(random);
    shared::QuadPart parts[shared::cube_faces];
    int count = 0, wholes = 0;
    for (int f = 0; f < shared::cube_faces; ++f) {
      parts[f] = shared::quad_part(n.light, n.quad, f);
      count += parts[f].any;
      wholes += parts[f].any && parts[f].whole;
    }
    ASSERT_GE(count, 1) << i;
    ASSERT_LE(wholes, 1) << i;
    // What is wholly in its centre's face is in no other, so that one may stop there.
    if (wholes == 1) {
      ASSERT_EQ(count, 1) << i;
      const int home = shared::face_of(shared::light_position(n.light, n.quad.center));
      ASSERT_TRUE(parts[home].any && parts[home].whole) << i;
    }
    whole += wholes, several += count > 1, everywhere += count == 6;
    for (int k = 0; k < 40; ++k) {
      const glm::dvec2 o = k < 4 ? glm::dvec2(shared::corner_offset(k))
                                 : glm::dvec2(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
      const glm::dvec3 p = in_light_space(n.light, point_in_double(n.quad, o));
      const int f = shared::face_of(glm::vec3(p));
      const shared::QuadPart& part = parts[f];
      ASSERT_TRUE(part.any) << i;
      const glm::dvec3 turned = [&] {  // on_face, in double
        const glm::vec3 x = shared::on_face({1, 0, 0}, f), y = shared::on_face({0, 1, 0}, f);
        const glm::vec3 z = shared::on_face({0, 0, 1}, f);
        return glm::dvec3(x) * p.x + glm::dvec3(y) * p.y + glm::dvec3(z) * p.z;
      }();
      const glm::dvec3 uvd(turned.x / turned.z, turned.y / turned.z, -1.0 / turned.z);
      for (int c = 0; c < 2; ++c) {
        ASSERT_GE(uvd[c], double(part.low[c]) - double(part.slack.x)) << i << " face " << f;
        ASSERT_LE(uvd[c], double(part.high[c]) + double(part.slack.x)) << i << " face " << f;
      }
      ASSERT_LE(uvd.z, double(part.high.z) + double(part.slack.y) + 1e-6 * std::abs(uvd.z)) << i << " face " << f;
    }
  }
  EXPECT_GT(whole, 10000);
  EXPECT_GT(several, 1000);
  EXPECT_GT(everywhere, 100);
}

}  // namespace
}  // namespace izb::test

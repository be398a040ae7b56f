// SPDX-License-Identifier: MIT
#include "reference/beam.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/error.h"
#include "reference/embree.h"
#include "reference/exact.h"
#include "reference/settle.h"
#include "reference_fixture.h"

namespace izb::reference {
namespace {

class ReferenceBeam : public testing::Test {
 protected:
  void SetUp() override {
    if (!embree_available()) GTEST_SKIP() << "built without Embree";
  }
};

// Random triangles, small and large, over a floor of many; receivers on the floor and on the triangles, seen from above
// by a perspective or an orthographic camera.
struct Frame {
  static constexpr uint32_t masked_seed = 6;

  Triangles triangles;
  Receivers receivers;

  // All but the floor are of a material with holes.
  std::shared_ptr<const Cutouts> blots(Random& random, uint32_t floor) const {
    Scene scene;
    scene.textures.emplace_back();
    scene.textures[0].width_px = scene.textures[0].height_px = 4;
    for (int i = 0; i < 16; ++i)
      scene.textures[0].rgba.insert(scene.textures[0].rgba.end(),
                                    {0, 0, 0, static_cast<uint8_t>(random.uniform(0.0, 256.0))});
    scene.materials.emplace_back();
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.materials[0].base_color_texture = 0;
    const auto cutouts = std::make_shared<Cutouts>(scene);
    cutouts->add_opaque(floor);
    for (size_t i = floor; i < triangles.count(); ++i) {
      glm::vec2 uvs[3];
      for (glm::vec2& uv : uvs) uv = glm::vec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      cutouts->add(0, uvs);
    }
    return cutouts;
  }

  Frame(bool perspective, int samples, uint32_t seed = 5) {
    Random random(seed);
    constexpr int cuts = 10;
    for (int i = 0; i < cuts; ++i)
      for (int k = 0; k < cuts; ++k) {
        const auto at = [](int n) { return -5.0f + static_cast<float>(n); };
        const auto corner = [&](int x, int y) { return glm::vec3(at(x), at(y), -20.0f); };
        add_triangle(triangles, corner(i, k), corner(i + 1, k), corner(i + 1, k + 1));
        add_triangle(triangles, corner(i, k), corner(i + 1, k + 1), corner(i, k + 1));
      }
    const uint32_t floor = static_cast<uint32_t>(triangles.count());
    for (int i = 0; i < 400; ++i) {
      const glm::vec3 at = random.point(-4.0, 4.0) * glm::vec3(1.0f, 1.0f, 0.4f) + glm::vec3(0.0f, 0.0f, -18.0f);
      const double size = i % 10 == 0 ? 2.0 : 0.3;
      add_triangle(triangles, at, at + random.point(-size, size), at + random.point(-size, size));
    }
    if (seed == masked_seed) triangles.cutouts = blots(random, floor);
    Receivers& r = receivers;
    r.camera = {perspective ? glm::dvec2(0.004, 0.003) : glm::dvec2(0.08, 0.06), perspective};
    if (samples == 32) r.offsets_px = random_offsets(random);
    const auto add = [&](uint32_t t, double u, double v) {
      const Corners c = corners(triangles, t);
      const glm::dvec3 a(c.a);
      const glm::vec3 p(a + u * (glm::dvec3(c.b) - a) + v * (glm::dvec3(c.c) - a));
      add_receiver(r, p, 1e-4f, t);
      r.slopes.push_back(tangent_slopes(glm::dvec3(p), normal(c), r.camera));
    };
    for (int n = 0; n < (samples == 1 ? 2500 : 400); ++n) {
      const uint32_t count = n % 2 == 0 ? floor : static_cast<uint32_t>(triangles.count());
      const double u = random.uniform(0.0, 1.0);
      add(static_cast<uint32_t>(random.uniform(0.0, count)), u, random.uniform(0.0, 1.0 - u));
    }
    for (size_t i = 0; i < r.classes.size(); i += 7) r.classes[i] = PixelClass::culled;
  }
};

const LightPoint lights[] = {{{0.3f, 0.2f, 1.0f}, false},
                             {{3e4f, 2e4f, 1e4f}, false},
                             {{1.0f, 0.0f, 0.0f}, false},  // along the floor
                             {{0.5f, -0.3f, -18.0f}, true},
                             {{5.0f, 9.0f, 10.0f}, true}};

void expect_exact(const Frame& frame, const LightPoint& light, const std::vector<uint32_t>& mask) {
  const std::vector<uint32_t> exact = exact_mask(frame.triangles, light, frame.receivers);
  const Settled settled = settle(frame.triangles, light, frame.receivers, mask, exact);
  // Doubles err within the start of the beams: at an edge or at a plane, of a few samples.
  EXPECT_EQ(settled.explained, settled.disputed);
  EXPECT_LE(settled.disputed, settled.compared / 2000);
}

// All pairs know no hierarchy: a triangle that shadows a sample which nothing else does must have been tested.
TEST_F(ReferenceBeam, MaskIsThatOfAllPairs) {
  for (const uint32_t seed : {5u, Frame::masked_seed})
    for (const int samples : {1, 32}) {
      const Frame frame(samples == 32 || seed == 5u, samples, seed);
      const BeamTracer tracer(frame.triangles);
      for (const LightPoint& light : lights) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << " samples " << samples << " light " << light.xyz_vs.x
                                        << " " << light.positional);
        const BeamCount count = tracer.trace(light, frame.receivers);
        expect_exact(frame, light, count.mask);
        EXPECT_EQ(count.pixels, static_cast<uint64_t>(std::count(frame.receivers.classes.begin(),
                                                                 frame.receivers.classes.end(), PixelClass::receiver)));
        EXPECT_EQ(count.tests, std::accumulate(count.tests_a_pixel.begin(), count.tests_a_pixel.end(), uint64_t{0}));
        EXPECT_GT(count.tests, 0u);
        // Far fewer than all pairs.
        EXPECT_LT(count.tests, count.pixels * frame.triangles.count() / 10);
        EXPECT_LT(count.node_tests, count.pixels * 300);
      }
    }
}

TEST_F(ReferenceBeam, MaskIsThatOfRaysButForTheirRounding) {
  for (const int samples : {1, 32}) {
    const Frame frame(true, samples);
    const BeamTracer tracer(frame.triangles);
    const RayTracer rays(frame.triangles);
    for (const LightPoint& light : lights) {
      const std::vector<uint32_t> beams = tracer.trace(light, frame.receivers).mask;
      const std::vector<uint32_t> traced = rays.trace_mask(light, frame.receivers).mask;
      // Rays have float points and float edges: where they differ from doubles, an edge or a plane is near.
      const Settled settled = settle(frame.triangles, light, frame.receivers, traced, beams);
      EXPECT_EQ(settled.explained, settled.disputed);
      EXPECT_LE(settled.disputed, settled.compared / 1000);
    }
  }
}

TEST_F(ReferenceBeam, OfAnOrthographicCameraAreTheirsToo) {
  const Frame frame(false, 32);
  const RayTracer rays(frame.triangles);
  for (const LightPoint& light : lights) {
    const std::vector<uint32_t> beams = BeamTracer(frame.triangles).trace(light, frame.receivers).mask;
    const std::vector<uint32_t> traced = rays.trace_mask(light, frame.receivers).mask;
    const Settled settled = settle(frame.triangles, light, frame.receivers, traced, beams);
    EXPECT_EQ(settled.explained, settled.disputed);
    EXPECT_LE(settled.disputed, settled.compared / 1000);
  }
}

TEST_F(ReferenceBeam, HolesLetLightThrough) {
  Frame frame(true, 32, Frame::masked_seed);
  const std::vector<uint32_t> cut = BeamTracer(frame.triangles).trace(lights[0], frame.receivers).mask;
  frame.triangles.cutouts = nullptr;
  const std::vector<uint32_t> whole = BeamTracer(frame.triangles).trace(lights[0], frame.receivers).mask;
  size_t lit = 0;
  for (size_t i = 0; i < cut.size(); ++i) {
    EXPECT_EQ(cut[i] & ~whole[i], 0u);
    lit += static_cast<size_t>(std::popcount(whole[i] & ~cut[i]));
  }
  EXPECT_GT(lit, 500u);
}

TEST_F(ReferenceBeam, ThreadsChangeNothing) {
  const Frame frame(true, 32);
  const BeamCount one = BeamTracer(frame.triangles, 1).trace(lights[0], frame.receivers);
  const BeamTracer tracer(frame.triangles, 1);
  for (int i = 0; i < 2; ++i) {
    const BeamCount again = tracer.trace(lights[0], frame.receivers);
    EXPECT_EQ(again.mask, one.mask);
    EXPECT_EQ(again.tests_a_pixel, one.tests_a_pixel);
    EXPECT_EQ(again.node_tests, one.node_tests);
  }
  EXPECT_EQ(BeamTracer(frame.triangles, 3).trace(lights[0], frame.receivers).mask, one.mask);
}

// A pile of layers: what is nearest hides the rest, from whichever side the triangles come.
TEST_F(ReferenceBeam, EndsWhenAllIsDark) {
  for (const bool upwards : {true, false}) {
    Triangles triangles;
    constexpr int layers = 64;
    for (int i = 0; i < layers; ++i) {
      const float height = 1.0f + static_cast<float>(upwards ? i : layers - 1 - i);
      add_triangle(triangles, {-40, height, -60}, {40, height, -60}, {0, height, 40});
    }
    Receivers receivers;
    Random random(3);
    receivers.offsets_px = random_offsets(random);
    receivers.camera = {{0.001, 0.001}, true};
    add_receiver(receivers, {0.0f, 0.0f, -20.0f});
    receivers.slopes.push_back(tangent_slopes({0.0, 0.0, -20.0}, {0.0, 1.0, 0.001}, receivers.camera));
    const BeamCount count = BeamTracer(triangles).trace({{0.0f, 1.0f, 0.0f}, false}, receivers);
    EXPECT_EQ(count.mask[0], dark);
    EXPECT_GE(count.tests, 1u);
    EXPECT_LE(count.tests, Hierarchy::largest_leaf);  // the nearest leaf's
  }
}

TEST_F(ReferenceBeam, OfNothingAboveTestsNothing) {
  Triangles triangles;
  add_rectangle(triangles, -5, 5, -5, 5, 0.0f);
  add_rectangle(triangles, -5, 5, -5, 5, -3.0f);
  Receivers receivers;
  for (int i = 0; i < 100; ++i) add_receiver(receivers, {0.01f * static_cast<float>(i) - 3.0f, 0.0f, 1.0f}, 1e-4f, 0);
  for (const LightPoint& light : {LightPoint{{0.2f, 1.0f, 0.1f}, false}, LightPoint{{0.2f, 4.0f, 0.1f}, true}}) {
    const BeamCount count = BeamTracer(triangles).trace(light, receivers);
    EXPECT_EQ(count.tests, 0u);
    EXPECT_EQ(count.pixels, 100u);
  }
}

TEST_F(ReferenceBeam, EndsAtTheLight) {
  Triangles triangles;
  add_rectangle(triangles, -5, 5, -5, 5, 9.0f);
  Receivers receivers;
  add_receiver(receivers, {0.0f, 0.0f, -2.0f});
  EXPECT_EQ(BeamTracer(triangles).trace({{0.0f, 8.0f, 0.0f}, true}, receivers).tests, 0u);
  const BeamCount beyond = BeamTracer(triangles).trace({{0.0f, 10.0f, 0.0f}, true}, receivers);
  EXPECT_EQ(beyond.mask[0], dark);
}

TEST_F(ReferenceBeam, RefusesWhatItCannotTrace) {
  EXPECT_THROW(BeamTracer(Triangles{}), Error);
  Frame frame(true, 1);
  const BeamTracer tracer(frame.triangles);
  frame.receivers.band.pop_back();
  EXPECT_THROW(tracer.trace(lights[0], frame.receivers), Error);
}

// Every triangle's part in a leaf's box lies in it: points of the triangle are found in one of its leaves.
TEST_F(ReferenceBeam, LeavesHoldTheirTriangles) {
  const Frame frame(true, 1, 9);
  const Hierarchy hierarchy = build_hierarchy(frame.triangles);
  std::vector<std::vector<Box>> boxes(frame.triangles.count());
  const auto visit = [&](const Hierarchy::Child& child, const auto& self) -> void {
    if (child.count == 0)
      for (const Hierarchy::Child& next : hierarchy.nodes[child.first]) {
        for (int k = 0; k < 3; ++k) {
          EXPECT_GE(next.box.lower[k], child.box.lower[k]);
          EXPECT_LE(next.box.upper[k], child.box.upper[k]);
        }
        self(next, self);
      }
    EXPECT_LE(child.count, Hierarchy::largest_leaf);
    for (uint32_t i = 0; i < child.count; ++i) boxes[hierarchy.references[child.first + i]].push_back(child.box);
  };
  visit(hierarchy.root, visit);
  EXPECT_GT(hierarchy.references.size(), frame.triangles.count());  // some were split
  Random random(2);
  for (uint32_t t = 0; t < frame.triangles.count(); ++t) {
    ASSERT_FALSE(boxes[t].empty());
    const Corners c = corners(frame.triangles, t);
    for (int n = 0; n < 50; ++n) {
      const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
      const glm::dvec3 p = glm::dvec3(c.a) + u * glm::dvec3(c.b - c.a) + v * glm::dvec3(c.c - c.a);
      const bool held = std::any_of(boxes[t].begin(), boxes[t].end(), [&](const Box& box) {
        const double slack = 1e-5;  // of the point itself, whose differences are floats
        return glm::all(glm::greaterThanEqual(p, glm::dvec3(box.lower) - slack)) &&
               glm::all(glm::lessThanEqual(p, glm::dvec3(box.upper) + slack));
      });
      EXPECT_TRUE(held) << t;
    }
  }
}

}  // namespace
}  // namespace izb::reference

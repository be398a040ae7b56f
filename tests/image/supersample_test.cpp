// SPDX-License-Identifier: MIT
// Supersampled frames: shares of pixels against areas in closed form, sums against the frames that they are of, and
// sums that were interrupted against those that were not.
#include "app/supersample.h"
#include "app/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "cpu/gltf_writer.h"
#include "image/exr.h"
#include "scene/glb_writer.h"
#include "scene/view.h"

namespace izb::test {
namespace {

constexpr int side_px = 48;
constexpr double half_side = 5.0, pixel = 2.0 * half_side / side_px;  // what the camera sees, in world units

using Polygon = std::vector<glm::dvec2>;  // convex, counter-clockwise

Polygon square(const glm::dvec2& center, double half, double turn_rad) {
  Polygon corners;
  for (const glm::dvec2& c : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(center + half * glm::dvec2(c.x * std::cos(turn_rad) - c.y * std::sin(turn_rad),
                                                 c.x * std::sin(turn_rad) + c.y * std::cos(turn_rad)));
  return corners;
}

double area(const Polygon& p) {
  double twice = 0.0;
  for (size_t i = 0; i < p.size(); ++i) {
    const glm::dvec2 a = p[i], b = p[(i + 1) % p.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

/// Cut by each edge of `clip` (Sutherland and Hodgman 1974).
Polygon intersection(Polygon subject, const Polygon& clip) {
  for (size_t i = 0; i < clip.size() && !subject.empty(); ++i) {
    const glm::dvec2 a = clip[i], edge = clip[(i + 1) % clip.size()] - a;
    const auto inside = [&](const glm::dvec2& p) { return edge.x * (p.y - a.y) - edge.y * (p.x - a.x); };
    Polygon cut;
    for (size_t k = 0; k < subject.size(); ++k) {
      const glm::dvec2 p = subject[k], q = subject[(k + 1) % subject.size()];
      const double at_p = inside(p), at_q = inside(q);
      if (at_p >= 0.0) cut.push_back(p);
      if ((at_p >= 0.0) != (at_q >= 0.0)) cut.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    subject = std::move(cut);
  }
  return subject;
}

/// The share of pixel i, top row first, that lies in the polygon.
double coverage(size_t i, const Polygon& polygon) {
  const double x = double(i % side_px), y = double(side_px - 1 - i / side_px);
  const glm::dvec2 center = (glm::dvec2(x, y) + 0.5) * pixel - half_side;
  return area(intersection(square(center, 0.5 * pixel, 0.0), polygon)) / (pixel * pixel);
}

void add_square(Scene& scene, const Polygon& corners, double z) {
  Mesh mesh;
  for (const glm::dvec2& c : corners) mesh.positions.emplace_back(c.x, c.y, z);
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({static_cast<uint32_t>(scene.meshes.size() - 1), glm::dmat4(1.0)});
}

/// A wall that ends within the picture, and a square before it whose shadow falls beside it.
struct Wall {
  Polygon wall, shadow;
  Scene scene;

  explicit Wall(double turn_rad) : wall(square({0, 0}, 4.37, 0.0)), shadow(square({2.43, 0.31}, 1.203, turn_rad)) {
    scene.name = "wall";
    scene.materials.emplace_back();
    add_square(scene, wall, 0.0);
    add_square(scene, square({2.43 - 4.5, 0.31}, 1.203, turn_rad), 3.0);
    Camera camera;
    camera.name = "front";
    camera.world_from_view = glm::translate(glm::dmat4(1.0), {0.0, 0.0, 10.0});
    camera.orthographic = true;
    camera.ymag = half_side, camera.near_plane = 0.1, camera.far_plane = 20.0;
    scene.cameras.push_back(camera);
    Light light;
    light.name = "sun";
    light.direction_ws = glm::normalize(glm::dvec3(4.5, 0.0, -3.0));
    scene.lights.push_back(light);
  }
};

using Words = std::vector<std::pair<std::string, std::string>>;

struct Supersample : testing::Test {
  const TemporaryFolder folder;

  std::string file_of(const Scene& scene) const {
    write_glb(scene, folder / "scene.glb");
    return folder / "scene.glb";
  }
  /// One at a time: each has a context, and makes it current when it begins.
  static std::unique_ptr<Session> session(const std::string& file, const std::string& technique,
                                          const Words& words = {}, const FrameOptions& given = {}) {
    FrameOptions options = given;
    options.size = fmt::format("{0}x{0}", side_px);
    options.technique = technique;
    std::unique_ptr<Technique> its = make_technique(technique);
    const OptionSet set = its->options();
    for (const auto& [name, value] : words)
      for (const Option& option : set.options())
        if (option.name == name) option.set(value);
    return std::make_unique<Session>(options, std::move(its), file);
  }
  static Accumulated sums(Session& s, int frames) {
    Accumulated all;
    accumulate(s, all, frames);
    return all;
  }
};

/// Errors of shares in pixels that an edge crosses.
struct Errors {
  double largest = 0.0, squares = 0.0;
  size_t pixels = 0;

  void add(double error, double truth) {
    if (!(truth > 1e-9 && truth < 1.0 - 1e-9)) {
      EXPECT_NEAR(error, 0.0, 1e-6);
      return;
    }
    largest = std::max(largest, std::abs(error));
    squares += error * error;
    ++pixels;
  }
  double rms() const { return std::sqrt(squares / double(std::max<size_t>(pixels, 1))); }
};

struct ShareErrors {
  Errors surface, lit;
};

ShareErrors share_errors(const Wall& wall, const Accumulated& sums) {
  ShareErrors errors;
  for (size_t i = 0; i < sums.pixel_count(); ++i) {
    const double seen = coverage(i, wall.wall), lit = seen - coverage(i, wall.shadow);
    errors.surface.add(double(sums.surface[i]) / sums.frames - seen, seen);
    errors.lit.add(double(sums.lights[0].lit[i]) / (32.0 * sums.frames) - lit, lit);
    EXPECT_EQ(sums.surface[i], sums.lights[0].receiver[i]) << i;
  }
  EXPECT_GT(errors.surface.pixels, 160u);
  EXPECT_GT(errors.lit.pixels, 200u);
  return errors;
}

TEST_F(Supersample, SharesAlongAnAxisAreAreasWithinOneFrame) {
  const Wall wall(0.0);
  for (const char* technique : {"izb", "ray_traced"})
    for (const int frames : {64, 256}) {
      const auto s = session(file_of(wall.scene), technique, {{"spp", "1"}});
      const ShareErrors errors = share_errors(wall, sums(*s, frames));
      // Of 2^k frames each column, and each row, of a pixel that is 2^-k wide sees one: an edge along it errs by less
      // than one. At a corner the box is cut into at most k columns, 1/2, 1/4, ... wide as the digits of its width say,
      // and a rest below 2^-k: in each column the frames are as even along its height, and err by less than one.
      const double corner = (std::log2(frames) + 1.0) / frames;
      for (const Errors& e : {errors.surface, errors.lit}) {
        EXPECT_LT(e.largest, corner) << technique;
        EXPECT_LT(e.rms(), 1.0 / frames) << technique;
      }
    }
}

TEST_F(Supersample, SharesAcrossThePixelsAreAreasToo) {
  const Wall wall(0.4);
  constexpr int frames = 256;
  for (const char* technique : {"izb", "ray_traced"}) {
    const auto s = session(file_of(wall.scene), technique, {{"spp", "1"}});
    const Errors lit = share_errors(wall, sums(*s, frames)).lit;
    // Of the 16 x 16 boxes with one frame each an edge crosses less than 32: they alone can be wrong. Random points
    // would err by up to 1/2 / sqrt(256) = 0.03 in the mean.
    EXPECT_LT(lit.largest, 32.0 / frames) << technique;
    EXPECT_LT(lit.rms(), 0.01) << technique;
  }
}

TEST_F(Supersample, AnyNumberOfFramesIsGood) {
  const Wall wall(0.4);
  const auto s = session(file_of(wall.scene), "ray_traced", {{"spp", "1"}});
  Accumulated all;
  for (const int frames : {7, 23, 100}) {
    accumulate(*s, all, frames);
    EXPECT_EQ(all.frames, frames);
    // Half of what random points would err by at most.
    EXPECT_LT(share_errors(wall, all).lit.rms(), 0.25 / std::sqrt(frames)) << frames;
  }
}

TEST_F(Supersample, OneFrameIsTheFrameAndTheSecondThatOfItsShift) {
  const Wall wall(0.4);
  const auto s = session(file_of(wall.scene), "ray_traced", {{"spp", "32"}});
  const auto expect_difference = [&](const Accumulated& before, const Accumulated& after) {
    const Image frame = frame_image(s->rendered(), nlohmann::json::object());
    size_t partly = 0;
    for (size_t i = 0; i < after.pixel_count(); ++i) {
      size_t c = 0;
      for (const char* name : {"R", "G", "B"}) {
        EXPECT_EQ(after.color[3 * i + c] - before.color[3 * i + c], double(frame.floats(name)[i]));
        ++c;
      }
      EXPECT_EQ(after.surface[i] - before.surface[i], frame.floats("depth")[i] > 0.0f);
      const uint32_t lit = after.lights[0].lit[i] - before.lights[0].lit[i];
      if (frame.floats("depth")[i] > 0.0f) {
        EXPECT_EQ(lit, 32.0f * frame.floats("visibility")[i]);
      }
      partly += lit > 0 && lit < 32;
    }
    EXPECT_GT(partly, 10u);
  };
  Accumulated none;
  const Accumulated one = sums(*s, 1), two = sums(*s, 2);
  none.color.resize(one.color.size()), none.surface.resize(one.surface.size());
  none.lights.resize(1, {std::vector<uint32_t>(one.surface.size()), std::vector<uint32_t>(one.surface.size())});
  s->renderer.render(s->frame.camera, s->frame.lights, s->timers);
  expect_difference(none, one);
  Camera shifted = s->frame.camera;
  shifted.pixel_shift = pixel_shift(1);
  s->renderer.render(shifted, s->frame.lights, s->timers);
  expect_difference(one, two);
  EXPECT_NE(two.color, one.color);
}

TEST_F(Supersample, InterruptedSumsAreTheSameBits) {
  const std::string file = file_of(Wall(0.4).scene);
  FrameOptions options;
  options.light = "0";
  options.point = "1,-1,2.5";  // whose exposure is measured
  const Words words{{"spp", "1"}};
  auto s = session(file, "ray_traced", words, options);
  const std::vector<Light> lights = s->frame.lights;
  std::vector<Accumulated> checkpoints;
  AccumulateSteps steps;
  steps.checkpoint_s = 0.0;
  steps.checkpoint = [&](const Accumulated& held) { checkpoints.push_back(held); };
  int frames = 0;
  steps.frame = [&](double) { ++frames; };
  Accumulated whole;
  accumulate(*s, whole, 12, steps);
  EXPECT_EQ(frames, 12);
  ASSERT_EQ(checkpoints.size(), 11u);
  ASSERT_TRUE(whole.exposure);
  EXPECT_NE(*whole.exposure, 1.0f);
  s.reset();
  for (const int at : {1, 5, 11}) {
    const Accumulated& held = checkpoints[size_t(at) - 1];
    EXPECT_EQ(held.frames, at);
    write_exr(folder / "sums.exr", image_of(held, lights));
    const auto later = session(file, "ray_traced", words, options);
    Accumulated resumed = accumulated_of(read_exr(folder / "sums.exr"), lights, at, held.exposure, "sums.exr");
    EXPECT_EQ(resumed, held);
    accumulate(*later, resumed, 12);
    EXPECT_EQ(resumed, whole) << at;
  }
  Image lacking = image_of(whole, lights);
  lacking.channels.pop_back();
  EXPECT_THROW(accumulated_of(lacking, lights, 12, whole.exposure, "x.exr"), Error);
}

TEST_F(Supersample, TechniquesAgree) {
  const std::string file = file_of(Wall(0.4).scene);
  const Accumulated a = sums(*session(file, "izb", {{"coverage", "exact"}, {"insertion", "exact"}}), 6);
  const Accumulated b = sums(*session(file, "ray_traced"), 6);
  EXPECT_EQ(a.surface, b.surface);
  EXPECT_EQ(a.lights[0].receiver, b.lights[0].receiver);
  size_t bits = 0, partly = 0;
  for (size_t i = 0; i < a.pixel_count(); ++i) {
    const uint32_t x = a.lights[0].lit[i], y = b.lights[0].lit[i];
    bits += x > y ? x - y : y - x;
    partly += x > 0 && x < 6 * 32;
  }
  EXPECT_GT(partly, 100u);
  EXPECT_LT(bits, 5u);  // single bits where a float ray touches an edge
}

TEST_F(Supersample, AMovedSceneIsNotTheOneBefore) {
  Scene scene = Wall(0.0).scene;
  scene.nodes.resize(1);
  scene.instances[1].node = 0;
  Track track;
  track.times_s = {0.0f, 1.0f};
  track.values = {0.0f, 0.0f, 0.0f, -0.7f, 0.9f, 0.0f};
  scene.animations.push_back({"slide", {track}, 1.0, ""});
  const std::string file = file_of(scene);
  FrameOptions options;
  options.time_s = 0.0;
  auto s = session(file, "ray_traced", {{"spp", "1"}}, options);
  const Accumulated before = sums(*s, 3);
  s->move_to(1.0);
  const Accumulated after = sums(*s, 3);
  EXPECT_NE(after, before);
  s.reset();
  options.time_s = 1.0;
  EXPECT_EQ(after, sums(*session(file, "ray_traced", {{"spp", "1"}}, options), 3));
}

}  // namespace
}  // namespace izb::test

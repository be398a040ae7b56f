// SPDX-License-Identifier: MIT
// Sea anemones on a rock: many thin arms with suckers, curled, that writhe as chains of joints and shadow each other.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/rig.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dquat;
using glm::dvec2;
using glm::dvec3;

constexpr int joints_an_arm = 9, keys = 32;
constexpr double length_s = 10.0;

/// An arm at rest: straight up from its root, so that bones need no turn; the animation's first key curls it.
struct Arm {
  dvec3 root, lean;  ///< where it stands and which way it leans
  double length, radius;
  int cuts, sides, suckers, sucker_sides;
};

double rock_height(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  return 1.15 * (1.0 - smooth_step(0.3, 3.2, r)) + 0.16 * fractal_noise({0.9 * x, 0.2, 0.9 * z}, 5, 31);
}

size_t triangles_of(const Arm& arm) {
  return size_t(arm.sides) * (2 * size_t(arm.cuts) - 1) + size_t(arm.suckers) * size_t(arm.sucker_sides) * 6;
}

/// Radius of an arm, t from root to tip.
double thickness(double t) {
  return (1.0 - 0.80 * t) * (1.0 + 0.35 * smooth_step(0.12, 0.0, t));
}

class ArmMesh {
 public:
  ArmMesh(const Arm& arm, Mesh& mesh, std::vector<Influence>& influences)
      : arm_(arm), mesh_(mesh), influences_(influences) {
    add_skin();
    for (int i = 0; i < arm.suckers; ++i) add_sucker(i);
  }

 private:
  void vertex(const dvec3& p, const dvec3& normal, double t) {
    mesh_.positions.emplace_back(p);
    mesh_.normals.emplace_back(glm::normalize(normal));
    // Joint k sits at t = k / joints; each vertex follows the two around it.
    const double x = std::clamp(t * joints_an_arm - 0.5, 0.0, joints_an_arm - 1.0);
    const int k = std::min(int(x), joints_an_arm - 2);
    const float second = float(smooth_step(0.0, 1.0, x - k));
    influences_.push_back({{uint16_t(k), second > 0.0f ? uint16_t(k + 1) : uint16_t{0}}, {1.0f - second, second}});
  }

  void add_skin() {
    const uint32_t first = uint32_t(mesh_.positions.size()), n = uint32_t(arm_.sides);
    for (int j = 0; j <= arm_.cuts; ++j) {
      const double t = double(j) / arm_.cuts, r = arm_.radius * thickness(t);
      if (j == arm_.cuts) {
        vertex(arm_.root + dvec3{0, arm_.length, 0}, {0, 1, 0}, t);
        break;
      }
      for (int i = 0; i < arm_.sides; ++i) {
        const dvec2 on = on_circle(2.0 * std::numbers::pi * i / arm_.sides);
        vertex(arm_.root + dvec3{r * on.x, arm_.length * t, -r * on.y}, {on.x, 0.8 * arm_.radius / arm_.length, -on.y},
               t);
      }
    }
    for (uint32_t j = 0; j < uint32_t(arm_.cuts); ++j)
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = first + j * n + i, c = first + j * n + (i + 1) % n;
        if (j + 1 == uint32_t(arm_.cuts))
          mesh_.indices.insert(mesh_.indices.end(), {a, c, first + (j + 1) * n});
        else
          mesh_.indices.insert(mesh_.indices.end(), {a, c, c + n, a, c + n, a + n});
      }
  }

  /// A shallow cup on the side that curls inwards.
  void add_sucker(int index) {
    const double t = 0.10 + 0.84 * (index / 2 + 0.5) / (0.5 * arm_.suckers), side = index % 2 == 0 ? 0.42 : -0.42;
    const dvec3 flat = glm::normalize(dvec3{arm_.lean.x, 0, arm_.lean.z} + dvec3{1e-4, 0, 0}),
                cross{flat.z, 0, -flat.x};
    const dvec2 turn = on_circle(side);
    const dvec3 out = turn.x * flat + turn.y * cross, other{out.z, 0, -out.x}, up{0, 1, 0};
    const double r = arm_.radius * thickness(t), size = 0.42 * r;
    const dvec3 centre = arm_.root + dvec3{0, arm_.length * t, 0} + out * (0.93 * r);
    const uint32_t first = uint32_t(mesh_.positions.size()), n = uint32_t(arm_.sucker_sides);
    constexpr dvec2 profile[]{{1.0, 0.0}, {1.05, 0.55}, {0.62, 0.60}, {0.30, 0.28}};
    for (const dvec2& q : profile)
      for (uint32_t i = 0; i < n; ++i) {
        const dvec2 on = on_circle(2.0 * std::numbers::pi * i / n);
        const dvec3 around = on.x * other + on.y * up;
        const double tilt = &q == &profile[0] ? 1.0 : &q == &profile[1] ? 0.6 : -0.5;
        vertex(centre + size * (q.x * around + q.y * out), tilt * around + 0.7 * out, t);
      }
    for (uint32_t row = 0; row < 3; ++row)
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = first + row * n + i, c = first + row * n + (i + 1) % n;
        mesh_.indices.insert(mesh_.indices.end(), {a, c, c + n, a, c + n, a + n});
      }
  }

  const Arm& arm_;
  Mesh& mesh_;
  std::vector<Influence>& influences_;
};

/// How joint k of an arm is turned at a moment of the loop, in turns.
dquat writhing(const Arm& arm, int k, double turn, double phase, double speed, double curl) {
  const dvec3 level{arm.lean.z, 0, -arm.lean.x}, side = glm::normalize(level + dvec3{0, 0, 1e-6});
  const dvec3 heading = glm::normalize(dvec3{arm.lean.x, 0, arm.lean.z} + dvec3{1e-6, 0, 0});
  const double t = double(k) / joints_an_arm, wave = 2.0 * std::numbers::pi * (speed * turn - 0.9 * t) + phase;
  const double bend = k == 0 ? 1.25 * glm::length(arm.lean) + 0.10 * sine(wave) : curl * (0.25 + t) + 0.24 * sine(wave);
  const double sway = (k == 0 ? 0.06 : 0.20) * cosine(wave * 1.0 + 1.3 + phase);
  return about(side, bend) * about(heading, sway);
}

struct Anemones {
  Builder& b;
  uint32_t flesh[3]{b.material("coral flesh", {0.62f, 0.24f, 0.18f}), b.material("violet flesh", {0.37f, 0.20f, 0.42f}),
                    b.material("ochre flesh", {0.60f, 0.42f, 0.18f})};
  std::vector<Track> tracks{};

  void add(const dvec3& foot, double size, int arms, uint64_t stream) {
    Random random = b.random(stream);
    const uint32_t paint = flesh[stream % 3];
    b.pen(paint).surface(b.pieces(70, 8), b.pieces(50, 4), {.wrap_u = true, .pole_end = true}, [&](double u, double v) {
      const dvec2 around = on_circle(2.0 * std::numbers::pi * u), up = on_circle(0.5 * std::numbers::pi * v);
      const double r =
          size * up.x *
          (0.42 + 0.07 * cosine(2.0 * std::numbers::pi * u * 9.0) * (1.0 - v) + 0.10 * smooth_step(0.3, 0.0, v));
      return foot + dvec3{r * around.x, -0.25 + 0.25 * v + 0.55 * size * up.y, -r * around.y};
    });
    for (int i = 0; i < arms; ++i) {
      const double rank = std::sqrt((i + 0.5) / arms);
      const dvec2 on = on_circle(2.399963229728653 * i + random.between(-0.2, 0.2));
      Arm arm;
      arm.root = foot + dvec3{0.33 * size * rank * on.x, 0.50 * size * std::sqrt(1.0 - 0.6 * rank * rank),
                              -0.33 * size * rank * on.y};
      arm.lean = rank * dvec3{on.x, 0, -on.y};
      arm.length = size * random.between(1.7, 2.5) * (1.05 - 0.25 * rank);
      arm.radius =
          size * random.between(0.040, 0.055) * std::min(1.6, std::sqrt(std::sqrt(1.0 / std::min(1.0, b.detail()))));
      arm.cuts = b.pieces(150, joints_an_arm), arm.sides = b.pieces(40, 4);
      arm.suckers = b.keeps(0.12) ? 2 * b.rounded(26 * std::min(1.0, b.detail() + 0.2), 2) : 0;
      arm.sucker_sides = b.pieces(19, 4);
      const double phase = random.between(0.0, 6.28), curl = random.between(0.06, 0.34),
                   speed = random.below(3) == 0 ? 2.0 : 1.0;
      b.add_count(triangles_of(arm));
      if (!b.counting()) write(arm, paint, phase, speed, curl);
    }
  }

  void write(const Arm& arm, uint32_t paint, double phase, double speed, double curl) {
    Scene& scene = b.scene();
    std::vector<uint32_t> chain;
    for (int k = 0; k < joints_an_arm; ++k) {
      const dvec3 step = k == 0 ? arm.root : dvec3{0, arm.length / joints_an_arm, 0};
      chain.push_back(add_node(scene, "joint", k == 0 ? -1 : int(chain.back()), step));
    }
    const int skin = add_skin(scene, chain);  // before the joints bend
    for (int k = 0; k < joints_an_arm; ++k) {
      std::vector<dquat> values;
      for (int key = 0; key <= keys; ++key)
        values.push_back(writhing(arm, k, double(key % keys) / keys, phase, speed, curl));
      scene.nodes[chain[size_t(k)]].rotation = values[0];
      tracks.push_back(rotation_track(chain[size_t(k)], length_s, keys, values));
    }
    Mesh mesh;
    mesh.name = "tentacle";
    mesh.material = paint;
    std::vector<Influence> influences;
    ArmMesh{arm, mesh, influences};
    add_skinned(scene, std::move(mesh), influences, skin);
  }
};

}  // namespace

void build_tentacles(Builder& b) {
  const uint32_t rock = b.material("rock", {0.33f, 0.30f, 0.27f}), sand = b.material("sand", {0.55f, 0.48f, 0.37f});
  b.camera("main", {{2.9, 3.5, 5.9}, {-0.1, 1.15, 0.0}}, 43.0);
  b.path({{{2.9, 3.5, 5.9}, {0.0, 1.15, 0.0}},
          {{-2.4, 2.6, 4.8}, {0.0, 1.3, 0.0}},
          {{-2.6, 2.3, 1.9}, {0.0, 1.7, 0.0}},
          {{0.6, 2.9, 3.0}, {0.2, 1.5, -0.2}},
          {{4.4, 2.5, 2.6}, {0.0, 1.3, 0.0}}},
         10.0, true, 45.0);
  b.camera("near", {{1.5, 2.45, 2.7}, {0.1, 1.85, 0.0}}, 42.0);

  const int cuts = b.pieces(300, 10);
  b.pen(rock).surface(cuts, cuts, {}, [](double u, double v) {
    // A disc, so that the rock's foot dips into the sand all around.
    const double a = 2.0 * u - 1.0, c = 1.0 - 2.0 * v;
    const double x = 3.6 * a * std::sqrt(1.0 - 0.5 * c * c), z = 3.6 * c * std::sqrt(1.0 - 0.5 * a * a);
    return dvec3{x, rock_height(x, z) - 0.5 * smooth_step(2.9, 3.6, std::sqrt(x * x + z * z)), z};
  });
  b.pen(sand).surface(b.pieces(220, 10), b.pieces(220, 10), {}, [](double u, double v) {
    const double x = 16.0 * (u - 0.5), z = 16.0 * (0.5 - v);
    return dvec3{x,
                 -0.12 + 0.03 * sine(5.0 * x + 2.0 * noise({0.6 * x, 0.1, 0.6 * z}, 8)) +
                     0.12 * noise({0.4 * x, 0.6, 0.4 * z}, 9),
                 z};
  });
  Anemones anemones{b};
  const double few = std::min(1.0, 0.06 + 1.1 * b.detail());
  const auto arms = [&](double usual) { return b.rounded(usual * few, 3); };
  anemones.add({0.0, rock_height(0, 0), 0.0}, 1.0, arms(90), 1);
  anemones.add({-1.6, rock_height(-1.6, 0.9), 0.9}, 0.62, arms(46), 2);
  anemones.add({1.45, rock_height(1.45, 1.0), 1.0}, 0.55, arms(42), 3);
  anemones.add({1.1, rock_height(1.1, -1.5), -1.5}, 0.66, arms(42), 4);
  anemones.add({-1.2, rock_height(-1.2, -1.4), -1.4}, 0.58, arms(36), 5);
  anemones.add({0.0, rock_height(0.0, 2.2), 2.2}, 0.36, arms(26), 6);
  if (!b.counting()) add_motion(b.scene(), "writhe", std::move(anemones.tracks), length_s);
  b.sun("sun", 226.0, 37.0, {1.0f, 0.95f, 0.86f}, 3.0f);
}

}  // namespace izb::procedural

// SPDX-License-Identifier: MIT
// A man who stands in a room and waves, lit by one lamp: a smooth skinned body, near and far from what receives its
// shadow, as the papers on soft shadows have it.
#include <algorithm>
#include <vector>

#include "scene/portable_math.h"
#include "scene/procedural/body.h"
#include "scene/procedural/parts.h"
#include "scene/procedural/scenes.h"

namespace izb::procedural {
namespace {

using glm::dquat;
using glm::dvec2;
using glm::dvec3;

constexpr int keys = 48;
constexpr double length_s = 6.0;

constexpr dvec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

/// The bones' turns at a moment of the loop, t in [0, 1], and how far the hips sink.
struct Pose {
  std::array<dquat, bone_count> turn;
  dvec3 hips;
};

Pose pose_at(double t) {
  Pose pose;
  pose.turn.fill(dquat{1, 0, 0, 0});
  const double once = 2.0 * std::numbers::pi * t,
               raised = smooth_step(0.08, 0.28, t) * (1.0 - smooth_step(0.72, 0.94, t));
  // The knees give a little and stay over the feet.
  const double knee = 0.14 + 0.07 * sine(once) + 0.05 * raised, shank = 0.405, thigh = 0.415;
  pose.hips = {0.012 * sine(once), -(thigh + shank) * (1.0 - cosine(knee)), 0.0};
  for (const int leg : {int(left_thigh), int(right_thigh)}) {
    pose.turn[size_t(leg)] = about(x_axis, -knee);
    pose.turn[size_t(leg) + 1] = about(x_axis, 2.0 * knee);
    pose.turn[size_t(leg) + 2] = about(x_axis, -knee);
  }
  pose.turn[spine] = about(z_axis, 0.03 * sine(once)) * about(x_axis, 0.03);
  pose.turn[chest] = about(y_axis, 0.10 * sine(once) - 0.12 * raised) * about(x_axis, 0.02 * sine(2.0 * once));
  pose.turn[neck] = about(y_axis, 0.15 * raised);
  pose.turn[head] = about(y_axis, 0.22 * raised + 0.08 * sine(once)) * about(x_axis, -0.05);
  pose.turn[left_arm] = about(z_axis, -0.38) * about(x_axis, 0.10 * sine(once));
  pose.turn[left_forearm] = about(x_axis, -0.35 - 0.12 * sine(once));
  // The right arm comes up sideways; the forearm stands upright and swings.
  const double swing = 0.34 * sine(3.0 * 2.0 * std::numbers::pi * (t - 0.28) / 0.44) * smooth_step(0.26, 0.32, t) *
                       (1.0 - smooth_step(0.66, 0.72, t));
  pose.turn[right_arm] = about(z_axis, glm::mix(0.38, -0.62, raised)) * about(x_axis, -0.25 * raised);
  pose.turn[right_forearm] = about(z_axis, -1.55 * raised + swing) * about(x_axis, -0.30 * (1.0 - raised));
  pose.turn[right_hand] = about(z_axis, 0.5 * swing);
  return pose;
}

void add_man(Builder& b, double cell) {
  const std::array<uint32_t, cloth_count> paints{
      b.material("skin", {0.62f, 0.40f, 0.29f}), b.material("hair", {0.12f, 0.08f, 0.05f}),
      b.material("shirt", {0.20f, 0.33f, 0.47f}), b.material("trousers", {0.23f, 0.22f, 0.21f}),
      b.material("shoes", {0.16f, 0.09f, 0.05f})};
  b.add_count(body_triangles(cell) + 2 * 2 * 16 * 14);
  if (b.counting()) return;
  Scene& scene = b.scene();
  std::vector<uint32_t> joints;
  for (const BoneShape& bone : skeleton()) {
    const bool root = bone.parent < 0;
    const dvec3 step = root ? bone.from : bone.from - skeleton()[size_t(bone.parent)].from;
    joints.push_back(add_node(scene, bone.name, root ? -1 : int(joints[size_t(bone.parent)]), step));
  }
  const int skin_index = add_skin(scene, joints);
  std::vector<Track> tracks;
  std::vector<dvec3> hips_at;
  std::array<std::vector<dquat>, bone_count> turns;
  for (int k = 0; k <= keys; ++k) {
    const Pose pose = pose_at(double(k % keys) / keys);
    hips_at.push_back(skeleton()[hips].from + pose.hips);
    for (size_t i = 0; i < bone_count; ++i) turns[i].push_back(pose.turn[i]);
  }
  // At rest he stands as in the middle of the loop, his arm up.
  const Pose rest = pose_at(0.40);
  scene.nodes[joints[hips]].translation = skeleton()[hips].from + rest.hips;
  tracks.push_back(translation_track(joints[hips], length_s, keys, hips_at));
  for (size_t i = 0; i < bone_count; ++i) {
    scene.nodes[joints[i]].rotation = rest.turn[i];
    tracks.push_back(rotation_track(joints[i], length_s, keys, turns[i]));
  }

  const Body body = make_body(cell);
  for (size_t cloth = 0; cloth < cloth_count; ++cloth) {
    if (body.triangles[cloth].empty()) continue;
    Mesh mesh;
    mesh.name = scene.materials[paints[cloth]].name;
    mesh.material = paints[cloth];
    std::vector<int64_t> number(body.positions.size(), -1);
    std::vector<Influence> influences;
    for (const uint32_t v : body.triangles[cloth]) {
      if (number[v] < 0) {
        number[v] = int64_t(mesh.positions.size());
        mesh.positions.emplace_back(body.positions[v]);
        mesh.normals.emplace_back(body.normals[v]);
        influences.push_back(body.influences[v]);
      }
      mesh.indices.push_back(uint32_t(number[v]));
    }
    add_skinned(scene, std::move(mesh), influences, skin_index);
  }
  const auto eye = [&](const char* name, const glm::vec3& color, double z, double radius) {
    Builder part{name, 0, b.detail(), false};
    const Pen pen = part.pen(part.material(name, color));
    for (const double x : {-0.034, 0.034}) pen.ball({x, 1.667, z}, radius, 16);
    Scene drawn = part.finish();
    Mesh mesh = std::move(drawn.meshes.front());
    mesh.material = b.material(name, color);
    const std::vector<Influence> influences(mesh.positions.size(), Influence{{head}, {1.0f}});
    add_skinned(scene, std::move(mesh), influences, skin_index);
  };
  eye("white of the eye", {0.75f, 0.73f, 0.70f}, 0.086, 0.0165);
  eye("iris", {0.10f, 0.07f, 0.05f}, 0.0965, 0.0085);
  add_motion(scene, "wave", std::move(tracks), length_s);
}

struct Room {
  Builder& b;
  uint32_t wall = b.material("wall", {0.58f, 0.55f, 0.50f}), boards = b.material("boards", {0.38f, 0.25f, 0.15f}),
           white = b.material("white paint", {0.74f, 0.72f, 0.68f}),
           wood = b.material("dark wood", {0.20f, 0.12f, 0.07f}), stone = b.material("marble", {0.68f, 0.66f, 0.63f}),
           leaf = b.material("leaf", {0.13f, 0.24f, 0.09f}, true), clay = b.material("clay", {0.48f, 0.22f, 0.13f});

  void shell() {
    const int count = b.rounded(30 * std::min(1.0, 0.2 + b.detail()), 5);
    for (int i = 0; i < count; ++i) {
      const double x = glm::mix(-3.4, 3.6, double(i) / count);
      b.pen(boards).box({x, -0.1, -2.6}, {x + 7.0 / count - 0.004, 0.0015 * ((i * 7) % 4) - 0.0045, 4.4});
    }
    b.pen(wall).box({-3.6, -0.2, -2.9}, {3.8, 3.1, -2.6});
    b.pen(wall).box({-3.75, -0.21, -2.95}, {-3.4, 3.12, 4.4});
    b.pen(white).box({-3.42, -0.05, -2.62}, {3.7, 0.11, -2.575});
    b.pen(white).box({-3.41, -0.06, -2.58}, {-3.375, 0.10, 4.39});
    // Panels on the wall.
    for (int i = 0; i < 5 && b.keeps(0.3); ++i) {
      const double x = -3.1 + 1.35 * i;
      for (const auto& [y0, y1] : {std::pair{0.25, 0.95}, {1.10, 2.75}}) {
        b.pen(white).box({x, y0, -2.62}, {x + 1.1, y0 + 0.05, -2.57});
        b.pen(white).box({x, y1 - 0.05, -2.62}, {x + 1.1, y1, -2.57});
        b.pen(white).box({x, y0 + 0.045, -2.615}, {x + 0.05, y1 - 0.045, -2.574});
        b.pen(white).box({x + 1.05, y0 + 0.045, -2.615}, {x + 1.1, y1 - 0.045, -2.574});
      }
    }
  }

  void chair(const dvec3& p, double turn_deg) {
    const Pen pen = b.pen(wood, at(p, turn_deg));
    const int sides = b.pieces(14, 4);
    for (const double x : {-0.20, 0.20}) {
      pen.tube(std::array{dvec3{x * 1.12, -0.004, 0.22}, dvec3{x * 1.02, 0.25, 0.20}, dvec3{x, 0.45, 0.18}}, 0.019,
               sides);
      pen.tube(std::array{dvec3{x * 1.1, -0.004, -0.25}, dvec3{x, 0.45, -0.19}, dvec3{x, 0.75, -0.23},
                          dvec3{x * 0.95, 0.98, -0.29}},
               0.019, sides);
      pen.rod({x * 1.05, 0.22, 0.2}, {x * 1.05, 0.22, -0.22}, 0.010, sides);
    }
    pen.rod({-0.21, 0.27, 0.2}, {0.21, 0.27, 0.2}, 0.010, sides);
    pen.box({-0.24, 0.435, -0.21}, {0.24, 0.47, 0.23});
    for (int i = 0; i < 5; ++i)
      pen.rod({-0.14 + 0.07 * i, 0.46, -0.195}, {-0.13 + 0.065 * i, 0.95, -0.28}, 0.008, sides);
    pen.beam({-0.225, 0.96, -0.283}, {0.225, 0.96, -0.283}, 0.022, 0.09, {0, 1, -0.25});
  }

  void props() {
    chair({-1.35, 0.0, -1.2}, 38.0);
    b.pen(stone, translated({1.45, 0.0, -1.55})).box({-0.27, -0.02, -0.27}, {0.27, 0.10, 0.27});
    add_column(b.pen(stone, translated({1.45, 0.09, -1.55})), 0.95, 0.15, b.pieces(40, 6));
    const glm::dmat4 pot = translated({1.45, 1.055, -1.55});
    const std::vector<dvec2> profile{{0, -0.01},   {0.09, -0.01}, {0.10, 0.02}, {0.17, 0.15},
                                     {0.18, 0.24}, {0.15, 0.31},  {0.19, 0.34}, {0.19, 0.36},
                                     {0.15, 0.35}, {0.13, 0.30},  {0, 0.29}};
    b.pen(clay, pot).lathe(profile, b.pieces(56, 6));
    Random random = b.random(4);
    const int fronds = b.rounded(34 * std::min(1.0, 0.2 + b.detail()), 5);
    for (int i = 0; i < fronds; ++i) {  // a fern
      const double turn = 2.4 * i, length = random.between(0.35, 0.62), lift = random.between(0.25, 0.8);
      const dvec2 on = on_circle(turn);
      const dvec3 out{on.x, 0, on.y}, side{-on.y, 0, on.x};
      b.pen(leaf, pot).surface(2, b.pieces(12, 3), {.pole_end = true}, [&](double u, double v) {
        const dvec3 spine_at = dvec3{0, 0.28, 0} + out * (length * v * (0.4 + 0.6 * v)) +
                               dvec3{0, length * (1.3 * lift * v - (0.6 + 0.5 * lift) * v * v), 0};
        const double wide =
            0.045 * (0.15 + 0.85 * sine(std::numbers::pi * std::min(0.999, 0.1 + 0.9 * v))) * (1.0 - v * v);
        return spine_at + side * (wide * (2.0 * u - 1.0)) - dvec3{0, 0.3 * wide * std::abs(2.0 * u - 1.0), 0};
      });
    }
    b.pen(clay).ball({0.95, 0.16, 0.75}, 0.16, b.pieces(60, 8));
    // A folding screen of laths, so that something thin stands in the light.
    for (int leaf_index = 0; leaf_index < 3; ++leaf_index) {
      const glm::dmat4 place =
          at({-2.9 + 0.55 * leaf_index, 0.0, -1.9 + (leaf_index % 2) * 0.22}, leaf_index % 2 == 0 ? -22.0 : 22.0);
      const Pen pen = b.pen(wood, place);
      for (const double x : {0.0, 0.56}) pen.box({x, -0.003, -0.015}, {x + 0.03, 1.72, 0.015});
      for (const double y : {0.08, 0.85, 1.66}) pen.box({0.028, y, -0.013}, {0.562, y + 0.04, 0.013});
      const int laths = b.rounded(9 * std::min(1.0, 0.3 + b.detail()), 2);
      for (int i = 0; i < laths; ++i) {
        const double x = 0.03 + 0.53 * (i + 0.5) / laths;
        pen.box({x - 0.007, 0.11, -0.006}, {x + 0.007, 1.67, 0.006});
      }
    }
  }
};

}  // namespace

void build_character(Builder& b) {
  b.set_flat_edge_m(0.5);
  b.camera("main", {{1.35, 1.55, 3.75}, {-0.05, 0.98, -0.35}}, 42.0);
  b.path({{{1.35, 1.55, 3.75}, {0.0, 1.0, -0.3}},
          {{-0.9, 1.4, 3.1}, {0.0, 1.0, -0.2}},
          {{-1.7, 1.7, 1.6}, {0.1, 1.15, 0.0}},
          {{0.2, 1.9, 1.9}, {0.0, 1.2, -0.1}},
          {{2.4, 1.9, 2.2}, {0.0, 1.0, -0.3}}},
         12.0, true, 44.0);
  b.camera("portrait", {{0.35, 1.66, 1.35}, {-0.10, 1.52, 0.0}}, 38.0);
  Room room{b};
  room.shell();
  room.props();
  add_man(b, 0.0069 / b.detail());

  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::spot;
  lamp.position_ws = {2.9, 3.6, 3.3};
  lamp.direction_ws = glm::normalize(dvec3{-0.25, 0.75, -0.5} - lamp.position_ws);
  lamp.color = {1.0f, 0.92f, 0.80f};
  lamp.intensity = 95.0f;
  lamp.inner_cone_rad = 30.0 * degree;
  lamp.outer_cone_rad = 42.0 * degree;
  b.scene().lights.push_back(lamp);
}

}  // namespace izb::procedural

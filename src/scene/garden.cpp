// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "scene/garden_parts.h"
#include "scene/procedural.h"
#include "scene/shapes.h"

namespace izb {
namespace {

using garden::degree;
using glm::dmat4;
using glm::dvec3;
using shapes::add_box;

// The court: paving up to two walls, behind (north) and to the right (east). The sun stands low in the
// west-south-west, behind the left shoulder of the main camera, so that shadows run through the picture and
// up the east wall.
constexpr double west = -7.0, east = 9.0, north = -6.0, south = 5.4;
constexpr double sunk_earth = -0.012;  // between the paving's top and the mortar's
constexpr double sun_azimuth_deg = 245.0, sun_elevation_deg = 11.0;
constexpr double to_sun_deg = 180.0 - sun_azimuth_deg;  // turns +z towards the sun

Bounds paved_area() {
  return {{west, 0, north}, {east, 0, south}};
}

dmat4 at(const dvec3& position, double turn_deg = 0.0) {
  return glm::rotate(glm::translate(dmat4{1.0}, position), turn_deg * degree, dvec3{0, 1, 0});
}

struct Builder {
  Scene scene;
  Random random;

  uint32_t material(const char* name, const glm::vec3& color, bool double_sided = false) {
    scene.materials.push_back(matte(name, color, double_sided));
    return static_cast<uint32_t>(scene.materials.size() - 1);
  }
  uint32_t mesh(Mesh m, uint32_t material_index) {
    m.material = material_index;
    scene.meshes.push_back(std::move(m));
    return static_cast<uint32_t>(scene.meshes.size() - 1);
  }
  void place(uint32_t mesh_index, const dmat4& world_from_object = dmat4{1.0}) {
    scene.instances.push_back({mesh_index, world_from_object});
  }
  void place(Mesh m, uint32_t material_index, const dmat4& world_from_object = dmat4{1.0}) {
    place(mesh(std::move(m), material_index), world_from_object);
  }
  void camera(const char* name, const dvec3& eye, const dvec3& target, double yfov_deg) {
    Camera c;
    c.name = name;
    c.world_from_view = glm::inverse(glm::lookAt(eye, target, dvec3{0, 1, 0}));
    c.yfov_rad = yfov_deg * degree;
    c.near_plane = 0.05;
    scene.cameras.push_back(c);
  }
};

struct Palette {
  uint32_t stone, mortar, soil, plaster, coping, terracotta, pale_stone, green_wood, blue_wood, raw_wood, iron, wire,
      glass, linen, red_paint, metal, rubber, leather, grass, bark, leaf;
};

Palette make_palette(Builder& b) {
  Palette p;
  p.stone = b.material("stone floor", {0.70f, 0.61f, 0.50f});
  p.mortar = b.material("mortar", {0.26f, 0.23f, 0.19f});
  p.soil = b.material("soil", {0.10f, 0.12f, 0.05f});
  p.plaster = b.material("plaster", {0.56f, 0.47f, 0.36f});
  p.coping = b.material("coping", {0.42f, 0.30f, 0.22f});
  p.terracotta = b.material("terracotta", {0.50f, 0.21f, 0.11f});
  p.pale_stone = b.material("pale stone", {0.62f, 0.59f, 0.54f});
  p.green_wood = b.material("green painted wood", {0.17f, 0.27f, 0.22f});
  p.blue_wood = b.material("blue painted wood", {0.13f, 0.24f, 0.33f});
  p.raw_wood = b.material("weathered wood", {0.34f, 0.25f, 0.17f});
  p.iron = b.material("iron", {0.08f, 0.08f, 0.09f});
  p.wire = b.material("wire", {0.10f, 0.09f, 0.09f});
  p.glass = b.material("milk glass", {0.80f, 0.76f, 0.66f});
  p.linen = b.material("linen", {0.74f, 0.70f, 0.62f}, true);
  p.red_paint = b.material("red paint", {0.42f, 0.06f, 0.05f});
  p.metal = b.material("metal", {0.45f, 0.45f, 0.46f});
  p.rubber = b.material("rubber", {0.04f, 0.04f, 0.04f});
  p.leather = b.material("leather", {0.26f, 0.13f, 0.07f});
  p.grass = b.material("grass", {0.15f, 0.25f, 0.07f}, true);
  p.bark = b.material("bark", {0.22f, 0.17f, 0.13f});
  p.leaf = b.material("leaf", {0.20f, 0.26f, 0.11f}, true);
  return p;
}

void add_site(Builder& b, const Palette& p) {
  Mesh soil, mortar, walls, coping;
  soil.name = "soil", mortar.name = "mortar", walls.name = "walls", coping.name = "coping";
  const auto ground = [](double u, double v) { return dvec3{-20.0 + 32.0 * u, -0.03, 14.0 - 24.0 * v}; };
  shapes::add_sheet(soil, 16, 12, ground);
  add_box(mortar, {west - 0.02, -0.2, north - 0.05}, {east + 0.05, -0.014, south});
  // The walls' ends and tops differ, so that no two faces share a plane.
  add_box(walls, {west, -0.1, north - 0.40}, {east + 0.30, 3.0, north});
  add_box(walls, {east, -0.12, north - 0.20}, {east + 0.40, 2.8, south + 0.6});
  add_box(coping, {west - 0.05, 2.98, north - 0.46}, {east + 0.36, 3.07, north + 0.07});
  add_box(coping, {east - 0.07, 2.77, north - 0.22}, {east + 0.47, 2.87, south + 0.67});
  b.place(std::move(soil), p.soil);
  b.place(std::move(mortar), p.mortar);
  b.place(std::move(walls), p.plaster);
  b.place(std::move(coping), p.coping);
  b.place(garden::paving(b.random, paved_area()), p.stone);

  constexpr double door_x = -0.2;
  b.place(garden::steps(), p.pale_stone, at({door_x, 0, north}));
  b.place(garden::door(), p.blue_wood, at({door_x, 0.45, north}));
  b.place(garden::shutters(), p.green_wood, at({-3.2, 1.05, north}));
  b.place(garden::shutters(), p.green_wood, at({4.1, 1.05, north}));
}

void add_furniture(Builder& b, const Palette& p) {
  // A trellis between the sun and the urn: its lattice of shadow bends over the body, runs on over the floor.
  b.place(garden::urn(), p.terracotta, at({4.0, 0, 0.63}));
  b.place(garden::trellis(1.5, 0.30, 1.75, 0.115), p.green_wood, at({1.6, 0, 1.75}, to_sun_deg));

  Bounds pergola;
  pergola.add({4.7, 0, -5.3});
  pergola.add({8.2, 2.45, -2.3});
  b.place(garden::pergola(pergola), p.raw_wood);
  b.place(garden::trellis(2.8, 0.25, 2.2, 0.14), p.raw_wood, at({4.71, 0, -3.8}, 90.0));
  b.place(garden::pedestal(), p.pale_stone, at({6.5, 0, -2.9}, 14.0));
  b.place(garden::ball(), p.pale_stone, at({6.5, 0.77, -2.9}));

  b.place(garden::ladder(), p.raw_wood, glm::rotate(at({1.9, 0, north + 0.78}, 4.0), -14.5 * degree, dvec3{1, 0, 0}));
  b.place(garden::chair(), p.blue_wood, at({0.7, 0, -1.2}, 130.0));
  b.place(garden::chair(), p.blue_wood, at({5.6, 0, -0.1}, 285.0));

  const uint32_t crate = b.mesh(garden::crate(), p.raw_wood);
  b.place(crate, at({5.3, 0.0, 2.5}, 23.0));
  b.place(crate, at({5.9, 0.0, 2.85}, -14.0));
  b.place(crate, at({5.55, 0.296, 2.65}, 8.0));

  b.place(garden::railing(3.9), p.iron, at({-4.1, 0, 1.0}, 90.0));
  b.place(garden::railing(3.2), p.iron, at({-5.0, 0, 6.75}, 90.0));
}

void add_bicycle(Builder& b, const Palette& p) {
  const garden::Bicycle bicycle = garden::bicycle();
  const dmat4 place = glm::rotate(at({-0.55, 0, 3.55}, -42.0), 5.0 * degree, dvec3{1, 0, 0});
  b.place(bicycle.paint, p.red_paint, place);
  b.place(bicycle.metal, p.metal, place);
  b.place(bicycle.rubber, p.rubber, place);
  b.place(bicycle.leather, p.leather, place);
}

void add_festoon(Builder& b, const Palette& p, uint32_t bulb, const dvec3& from, const dvec3& to, double sag) {
  b.place(garden::wire(from, to, sag, 0.004), p.wire);
  const int count = static_cast<int>(glm::length(to - from) / 0.55);
  for (int i = 1; i < count; ++i) {
    const double t = (i + 0.15 * b.random.between(-1, 1)) / count;
    b.place(bulb, at(garden::on_line(from, to, sag, t), b.random.between(0, 360)));
  }
}

void add_wires(Builder& b, const Palette& p) {
  const uint32_t bulb = b.mesh(garden::bulb(), p.glass);
  Mesh mast;
  mast.name = "mast";
  shapes::add_rod(mast, {-4.6, -0.3, 0.4}, {-4.6, 3.45, 0.4}, 0.045, 20);
  b.place(std::move(mast), p.raw_wood);
  add_festoon(b, p, bulb, {-4.58, 3.30, 0.38}, {east + 0.03, 2.45, -1.0}, 0.55);
  add_festoon(b, p, bulb, {-4.58, 3.25, 0.42}, {east + 0.03, 2.50, 3.2}, 0.60);
  add_festoon(b, p, bulb, {-4.62, 3.20, 0.36}, {3.0, 2.75, north - 0.03}, 0.45);

  // Clothes lines between two T-shaped posts.
  const dvec3 left{-3.1, 2.0, -3.4}, right{1.3, 2.0, -3.0};
  const dvec3 arm{-0.05, 0, 0.55};
  Mesh posts;
  posts.name = "line posts";
  for (const dvec3& top : {left, right}) {
    shapes::add_rod(posts, {top.x, -0.3, top.z}, top + dvec3{0, 0.03, 0}, 0.03, 16);
    shapes::add_rod(posts, top - arm, top + arm, 0.018, 12);
  }
  b.place(std::move(posts), p.iron);
  for (const double k : {-0.92, -0.31, 0.31, 0.92}) {
    b.place(garden::wire(left + k * arm, right + k * arm, 0.07, 0.003), p.wire);
  }
  const double along_deg = std::atan2(left.z - right.z, right.x - left.x) / degree;
  const auto hang = [&](double k, double t, double width, double height, double phase) {
    const dvec3 top = garden::on_line(left + k * arm, right + k * arm, 0.07, t) + dvec3{0, 0.004, 0};
    b.place(garden::cloth(width, height, 0.035, phase), p.linen, at(top, along_deg));
  };
  hang(0.92, 0.28, 0.85, 0.95, 0.4);
  hang(0.31, 0.63, 1.05, 1.25, 2.1);
  hang(-0.31, 0.85, 0.45, 0.60, 4.0);

  // Overhead cables from the street, far out to the west.
  Mesh pole;
  pole.name = "pole";
  shapes::add_rod(pole, {-12.0, -0.5, 12.4}, {-12.0, 6.4, 12.4}, 0.11, 24);
  shapes::add_rod(pole, {7.4, 2.9, north - 0.2}, {7.4, 4.5, north - 0.2}, 0.035, 16);
  b.place(std::move(pole), p.raw_wood);
  for (int i = 0; i < 4; ++i) {
    b.place(garden::wire({-11.9, 5.3 + 0.3 * i, 12.4}, {7.4, 3.6 + 0.22 * i, north - 0.2}, 0.8, 0.006), p.wire);
  }
}

void add_plants(Builder& b, const Palette& p) {
  constexpr double cell = 1.0;
  const uint32_t rows = static_cast<uint32_t>(garden::paving_rows(paved_area()));
  std::vector<uint32_t> patches, tufts;
  for (int i = 0; i < 4; ++i) patches.push_back(b.mesh(garden::grass_patch(b.random, cell, 620, 0.05, 0.24), p.grass));
  for (int i = 0; i < 3; ++i) tufts.push_back(b.mesh(garden::grass_tuft(b.random), p.grass));
  const auto add_patch = [&](double x, double z) {
    const uint32_t patch = patches[b.random.below(4)];
    const dvec3 position{x, b.random.between(-0.01, 0.0), z};
    b.place(patch, at(position, 90.0 * b.random.below(4)));
  };
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 3; ++j) add_patch(-3.9 + i * cell, south + 0.53 + j * cell);
  }
  for (int i = 0; i < 6; ++i) add_patch(west - 0.53 - b.random.between(0, 0.4), south - 0.5 - 1.6 * i);
  for (int i = 0; i < 70; ++i) {
    const double x = b.random.between(-4.0, east - 0.2), row = 1.0 + b.random.below(rows - 1);
    b.place(tufts[b.random.below(3)], at({x, 0, north + (south - north) * row / rows}));
  }
  // Tall grass in a bed at the left edge of the picture: its shadows cross the foreground.
  constexpr dvec3 bed{-2.75, 0, 2.6};
  b.place(garden::raised_bed(1.5, 2.1), p.pale_stone, at(bed));
  Mesh earth;
  earth.name = "earth";
  add_box(earth, {-0.70, sunk_earth, -1.0}, {0.70, 0.10, 1.0});
  b.place(std::move(earth), p.soil, at(bed));
  b.place(garden::grass_patch(b.random, 1.25, 900, 0.2, 0.62), p.grass, at(bed + dvec3{0, 0.12, 0.3}));
  b.place(garden::grass_patch(b.random, 1.25, 800, 0.2, 0.55), p.grass, at(bed + dvec3{0, 0.12, -0.3}));

  // Two placements of one tree, both outside the main picture: only their shadows are in it.
  garden::Tree tree = garden::tree(b.random);
  const uint32_t wood = b.mesh(std::move(tree.wood), p.bark), leaves = b.mesh(std::move(tree.leaves), p.leaf);
  for (const dmat4& place : {at({-6.6, 0, 8.3}), at({-8.4, 0, -2.9}, 140.0)}) {
    b.place(wood, place);
    b.place(leaves, place);
  }
}

}  // namespace

Scene make_garden(uint32_t seed) {
  Builder b{{}, Random{seed}};
  b.scene.name = "garden";
  const Palette palette = make_palette(b);
  add_site(b, palette);
  add_furniture(b, palette);
  add_bicycle(b, palette);
  add_wires(b, palette);
  add_plants(b, palette);

  b.camera("main", {-2.5, 1.55, 8.2}, {2.2, 0.62, 0.0}, 42.0);
  b.camera("wires", {3.0, 1.25, -0.9}, {9.0, 1.35, -1.0}, 48.0);
  b.camera("grass", {-0.35, 0.5, 0.6}, {-1.7, 0.12, 2.6}, 45.0);
  b.camera("contact", {3.9, 0.9, 4.4}, {5.7, 0.15, 2.5}, 40.0);

  Light sunset;
  sunset.name = "sunset";
  const double azimuth = sun_azimuth_deg * degree, elevation = sun_elevation_deg * degree;
  sunset.direction_ws =
      -dvec3{std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
  sunset.color = {1.0f, 0.80f, 0.58f};
  sunset.intensity = 3.0f;
  b.scene.lights.push_back(sunset);
  return std::move(b.scene);
}

}  // namespace izb

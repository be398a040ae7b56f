// SPDX-License-Identifier: MIT
#include "scene/procedural/plane_parts.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/portable_math.h"

namespace izb::procedural {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;
constexpr dvec3 forward{1, 0, 0};

/// A smooth curve through evenly spaced values, t in [0, 1].
template <size_t n>
double through(const std::array<double, n>& values, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (n - 1);
  const int i = std::min(int(x), int(n) - 2);
  const double f = x - i;
  const auto at = [&](int k) { return values[size_t(std::clamp(k, 0, int(n) - 1))]; };
  const double a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
  return b + 0.5 * f * (c - a + f * (2.0 * a - 5.0 * b + 4.0 * c - d + f * (3.0 * (b - c) + d - a)));
}

constexpr double body_front = 1.42, body_back = -3.30;

constexpr double root_z = 0.52, tip_z = 3.80;

/// The right wing: u from the trailing edge over the top to the nose (0.5) and back below; v from root to tip.
dvec3 wing_at(double u, double v) {
  const double side = u < 0.5 ? 1.0 : -1.0, s = 1.0 - 2.0 * u;  // s = 1, 0, -1
  const double x = s * s, root = std::abs(s);
  const double half =
      5.0 * 0.115 * (0.2969 * root - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
  const double round =
      v < 0.82 ? 1.0 : std::sqrt(std::max(0.0, 1.0 - ((v - 0.82) / 0.18) * ((v - 0.82) / 0.18) * 0.985));
  const double chord = glm::mix(1.52, 1.08, v) * round;
  const double nose = glm::mix(0.72, 0.60, v) - 0.32 * (1.0 - round);
  const double camber = 0.05 * x * (1.0 - x);
  return {nose - chord * x, -0.26 + 0.055 * (root_z + v * (tip_z - root_z)) + chord * (camber + side * half),
          glm::mix(root_z, tip_z, v)};
}

/// A fin or half a tailplane: like the wing, with a profile of its own.
dvec3 fin_at(double u, double v, double root_chord, double tip_chord, double span, double sweep) {
  const double side = u < 0.5 ? 1.0 : -1.0, s = 1.0 - 2.0 * u, x = s * s, root = std::abs(s);
  const double half =
      5.0 * 0.085 * (0.2969 * root - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
  const double round = v < 0.7 ? 1.0 : std::sqrt(std::max(0.0, 1.0 - ((v - 0.7) / 0.3) * ((v - 0.7) / 0.3) * 0.97));
  const double chord = glm::mix(root_chord, tip_chord, v) * round;
  return {-sweep * v - 0.4 * root_chord * (1.0 - round) - chord * x, side * half * chord, span * v};
}

}  // namespace

dvec3 plane_body(double t, double turn) {
  const double high = through(std::array{0.78, 0.82, 0.81, 0.75, 0.66, 0.55, 0.43, 0.30, 0.17, 0.055}, t);
  const double wide = through(std::array{0.78, 0.80, 0.76, 0.68, 0.56, 0.43, 0.31, 0.19, 0.085, 0.018}, t);
  const double middle = through(std::array{0.0, 0.0, 0.01, 0.03, 0.06, 0.09, 0.12, 0.16, 0.20, 0.235}, t);
  const dvec2 on = on_circle(turn);
  return {glm::mix(body_front, body_back, t), middle + high * on.x, wide * on.y};
}

PlanePalette::PlanePalette(Builder& b) {
  red = b.material("red lacquer", {0.52f, 0.045f, 0.035f});
  white = b.material("white lacquer", {0.80f, 0.78f, 0.72f});
  metal = b.material("bare metal", {0.50f, 0.50f, 0.51f});
  dark = b.material("dark metal", {0.13f, 0.13f, 0.14f});
  rubber = b.material("rubber", {0.045f, 0.045f, 0.045f});
  leather = b.material("leather", {0.25f, 0.13f, 0.07f});
  wood = b.material("laminated wood", {0.36f, 0.20f, 0.10f});
  brass = b.material("brass", {0.55f, 0.40f, 0.14f});
}

Pen PlaneParts::pen(uint32_t material, bool left) const {
  dmat4 mirror{1.0};
  mirror[2][2] = left ? -1.0 : 1.0;
  return b_.pen(material, place_ * mirror);
}

void PlaneParts::oriented(const Pen& pen, int cuts_u, int cuts_v, const Closing& closing, const Sheet& sheet,
                          const dvec3& inside) const {
  const double step = 1e-3;
  const dvec3 p = sheet(0.3, 0.5);
  const dvec3 normal = glm::cross(sheet(0.3 + step, 0.5) - p, sheet(0.3, 0.5 + step) - p);
  if (glm::dot(normal, p - inside) > 0.0)
    pen.surface(cuts_u, cuts_v, closing, sheet);
  else
    pen.surface(cuts_u, cuts_v, closing, [&](double u, double v) { return sheet(1.0 - u, v); });
}

void PlaneParts::trimmed(const Pen& pen, double cuts_u, double cuts_v, const Sheet& sheet, const dvec3& inside) const {
  // Panels stop short of each other by a joint, whose edge turns inwards.
  constexpr double joint = 0.004, fringe = 0.010;
  const int nu = b_.pieces(cuts_u, 2), nv = b_.pieces(cuts_v, 2);
  const bool fringes = b_.keeps(0.2);
  const double a = fringes ? fringe : joint;
  const auto inner = [&](double u, double v) { return sheet(glm::mix(a, 1.0 - a, u), glm::mix(a, 1.0 - a, v)); };
  oriented(pen, nu, nv, {}, inner, inside);
  if (!fringes) return;
  for (int edge = 0; edge < 4; ++edge) {
    // Much finer along the edge than the sheet needs: slivers.
    const int along = b_.pieces(2.6 * (edge < 2 ? cuts_u : cuts_v), 3);
    oriented(
        pen, along, 1, {},
        [&](double s, double w) {
          const double t = glm::mix(joint, a, edge % 2 == 0 ? w : 1.0 - w), e = glm::mix(t, 1.0 - t, s);
          const double far = edge % 2 == 0 ? t : 1.0 - glm::mix(joint, a, 1.0 - w);
          return edge < 2 ? sheet(e, far) : sheet(far, e);
        },
        inside);
  }
}

void PlaneParts::rivets(const Pen& pen, const Sheet& sheet, const dvec3& inside, const dvec2& from, const dvec2& to,
                        double spacing) const {
  double length = 0.0;
  for (int i = 0; i < 16; ++i) {
    const dvec2 s = glm::mix(from, to, i / 16.0), e = glm::mix(from, to, (i + 1) / 16.0);
    length += glm::length(sheet(e.x, e.y) - sheet(s.x, s.y));
  }
  const int count = int(length / spacing);
  for (int i = 0; i < count; ++i) {
    if (!b_.keeps(0.35)) continue;
    const int sides = b_.pieces(14, 4), rows = b_.pieces(5, 1);
    if (b_.counting()) {
      b_.add_count(size_t(sides) * (2 * size_t(rows) - 1));
      continue;
    }
    const dvec2 at_uv = glm::mix(from, to, (i + 0.5) / count);
    const dvec3 p = sheet(at_uv.x, at_uv.y), du = sheet(at_uv.x + 1e-3, at_uv.y) - p,
                dv = sheet(at_uv.x, at_uv.y + 1e-3) - p;
    dvec3 out = glm::normalize(glm::cross(du, dv));
    if (glm::dot(out, p - inside) < 0.0) out = -out;
    pen.in(along(p, out)).surface(sides, rows, {.wrap_u = true, .pole_end = true}, [&](double u, double v) {
      const dvec2 on = on_circle(2.0 * pi * u), up = on_circle(0.5 * pi * v);
      return dvec3{0.0034 * up.x * on.x, -0.0003 + 0.0017 * up.y, -0.0034 * up.x * on.y};
    });
  }
}

void PlaneParts::fuselage() const {
  constexpr int rings = 9, around = 10;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double t0 = double(i) / rings, t1 = double(i + 1) / rings, a0 = 2.0 * pi * k / around,
                   a1 = 2.0 * pi * (k + 1) / around;
      const Sheet sheet = [=](double u, double v) { return plane_body(glm::mix(t0, t1, u), glm::mix(a0, a1, v)); };
      // The cockpit's opening takes two panels on top.
      if ((i == 5 || i == 6) && (k == 0 || k == around - 1)) continue;
      const dvec3 axis{glm::mix(body_front, body_back, 0.5 * (t0 + t1)), 0.08, 0};
      // Scallops: the red reaches further back along the flanks' middle.
      const bool red = i < 3 + (k % 5 == 2 ? 2 : k % 5 == 1 || k % 5 == 3 ? 1 : 0) || i == rings - 1;
      const Pen skin = pen(red ? p_.red : p_.white);
      trimmed(skin, 150, 130, sheet, axis);
      rivets(skin, sheet, axis, {0.03, 0.06}, {0.03, 0.94}, 0.024);
      rivets(skin, sheet, axis, {0.97, 0.06}, {0.97, 0.94}, 0.024);
      rivets(skin, sheet, axis, {0.06, 0.05}, {0.94, 0.05}, 0.024);
      rivets(skin, sheet, axis, {0.5, 0.06}, {0.5, 0.94}, 0.048);
    }
  // Formers and a dark lining show through the joints and the cockpit.
  oriented(pen(p_.dark), b_.pieces(80, 8), b_.pieces(120, 6), {.wrap_v = true},
           [](double u, double v) {
             const dvec3 p = plane_body(0.985 * u, 2.0 * pi * v), c{p.x, 0.08, 0};
             const double t = 0.985 * u, cut = t > 0.54 && t < 0.785 && (v < 0.105 || v > 0.895) ? 0.62 : 0.985;
             return c + (p - c) * cut;
           },
           {0, 0.08, 0});
}

void PlaneParts::cowl() const {
  // Blisters over the nine cylinders' rockers; the lip rolls in.
  const Sheet outer = [](double u, double v) {
    const double x = glm::mix(1.40, 2.30, v), turn = 2.0 * pi * u;
    const double lip = smooth_step(0.62, 1.0, v), base = 0.80 - 0.23 * lip * lip;
    const double lobe = cosine(4.5 * turn) * cosine(4.5 * turn), along_x = (v - 0.45) / 0.2;
    const double bump = 0.055 * lobe * lobe * lobe / (1.0 + along_x * along_x * along_x * along_x);
    const dvec2 on = on_circle(turn);
    return dvec3{x, (base + bump) * on.x, (base + bump) * on.y};
  };
  for (int k = 0; k < 9; ++k) {
    const Sheet part = [&](double u, double v) { return outer((k + u) / 9.0, v); };
    trimmed(pen(p_.red), 110, 170, part, {1.8, 0, 0});
    for (const double edge : {0.03, 0.97}) rivets(pen(p_.red), part, {1.8, 0, 0}, {edge, 0.04}, {edge, 0.9}, 0.022);
    for (const double row : {0.03, 0.5}) rivets(pen(p_.red), part, {1.8, 0, 0}, {0.06, row}, {0.94, row}, 0.022);
  }
  std::vector<dvec2> inner;
  const int cuts = b_.pieces(60, 6);
  for (int i = 0; i <= cuts; ++i) {
    const dvec2 on = on_circle(pi * i / cuts);
    inner.push_back({0.545 + 0.028 * on.x, 2.296 + 0.03 * on.y});
  }
  for (int i = 1; i <= 4; ++i) inner.push_back({0.517 + 0.055 * i, 2.296 - 0.22 * i});
  pen(p_.red).in(along({0, 0, 0}, forward)).lathe(inner, b_.pieces(420, 16));
}

void PlaneParts::wing(bool left) const {
  constexpr int bays = 7;
  for (int bay = 0; bay < bays; ++bay)
    for (int part = 0; part < 4; ++part) {  // aft and fore, above and below
      const std::array edges{0.0, 0.22, 0.5, 0.78, 1.0};
      const double v0 = double(bay) / bays, v1 = bay + 1 == bays ? 0.9995 : double(bay + 1) / bays;
      const Sheet sheet = [=](double u, double v) {
        return wing_at(glm::mix(edges[size_t(part)], edges[size_t(part) + 1], u), glm::mix(v0, v1, v));
      };
      const dvec3 core{0.05, -0.24 + 0.055 * glm::mix(root_z, tip_z, 0.5 * (v0 + v1)),
                       glm::mix(root_z, tip_z, 0.5 * (v0 + v1))};
      const bool red = bay == 0 || bay == bays - 1 || ((part == 1 || part == 2) && bay < 2);
      const Pen skin = pen(red ? p_.red : p_.white, left);
      trimmed(skin, part == 0 || part == 3 ? 90 : 150, 130, sheet, core);
      rivets(skin, sheet, core, {0.05, 0.03}, {0.95, 0.03}, 0.021);
      rivets(skin, sheet, core, {0.05, 0.5}, {0.95, 0.5}, 0.042);
      rivets(skin, sheet, core, {part == 0 || part == 2 ? 0.95 : 0.05, 0.06},
             {part == 0 || part == 2 ? 0.95 : 0.05, 0.94}, 0.021);
    }
  // A core inside shows in the joints.
  oriented(pen(p_.dark, left), b_.pieces(120, 8), b_.pieces(40, 2), {.wrap_u = true},
           [](double u, double v) {
             const dvec3 p = wing_at(u, 0.985 * v), c{0.05, -0.26 + 0.055 * p.z, p.z};
             return c + (p - c) * 0.975;
           },
           {0.05, -0.15, 2.0});
  // The fillet between wing and fuselage, widening aft.
  oriented(pen(p_.red, left), b_.pieces(420, 8), b_.pieces(90, 2), {},
           [](double u, double v) {
             const double s = 0.03 + 0.94 * u;
             const dvec3 on_wing = wing_at(s, 0.115), at_root = wing_at(s, 0.0);
             const double aft = smooth_step(0.4, -0.9, on_wing.x), size = (0.09 + 0.20 * aft) * (s < 0.5 ? 1.0 : -0.7);
             const double t = (body_front - on_wing.x) / (body_front - body_back);
             const dvec2 flank = on_circle(pi * 0.5 + 0.28 - 0.9 * size);
             const dvec3 on_body =
                 plane_body(t, 0.0) * dvec3{1, 0, 0} +
                 dvec3{0, plane_body(t, pi * 0.5).y + (plane_body(t, 0.0).y - plane_body(t, pi * 0.5).y) * flank.x,
                       0.985 * plane_body(t, pi * 0.5).z * flank.y};
             const dvec3 corner{on_wing.x, at_root.y, std::max(root_z * 0.8, on_body.z + 0.02)};
             return glm::mix(glm::mix(on_body, corner, v), glm::mix(corner, on_wing, v), v);
           },
           {0.0, -0.9, 0.0});
  // Landing and flying wires.
  const int sides = b_.pieces(26, 4);
  for (const double v : {0.42, 0.66})
    for (const double x : {0.22, 0.27}) {
      const dvec3 on_wing = wing_at(x, v);
      pen(p_.metal, left).rod(on_wing, plane_body(0.18 + (x - 0.22) * 2.0, 0.5), 0.006, sides);
      pen(p_.metal, left).rod(wing_at(1.0 - x, v), {0.35 + (0.25 - x) * 3.0, -1.0, 0.95}, 0.006, sides);
    }
}

void PlaneParts::wings() const {
  wing(false);
  wing(true);
}

void PlaneParts::tail() const {
  const auto surface = [&](const dmat4& place, bool left, double root, double tip, double span, double sweep,
                           uint32_t paint) {
    for (int part = 0; part < 4; ++part) {
      const std::array edges{0.0, 0.27, 0.5, 0.73, 1.0};
      const Sheet sheet = [=](double u, double v) {
        return fin_at(glm::mix(edges[size_t(part)], edges[size_t(part) + 1], u), 0.9995 * v, root, tip, span, sweep);
      };
      const dvec3 core{-0.45 * root, 0, 0.5 * span};
      const Pen skin = pen(paint, left).in(place);
      trimmed(skin, 120, 150, sheet, core);
      for (int i = 1; i < 7; ++i) rivets(skin, sheet, core, {0.06, i / 7.0}, {0.94, i / 7.0}, 0.02);
    }
  };
  for (const bool left : {false, true}) surface(translated({-2.28, 0.18, 0.02}), left, 0.95, 0.62, 1.25, 0.12, p_.red);
  surface(translated({-2.36, 0.30, 0}) * turned(0, -90.0), false, 1.0, 0.52, 0.92, 0.36, p_.white);
  const Pen skid = pen(p_.dark);
  skid.tube(std::array{dvec3{-2.75, 0.02, 0}, dvec3{-2.98, -0.24, 0}, dvec3{-3.10, -0.33, 0}}, 0.022, b_.pieces(30, 4));
  pen(p_.rubber).ring({-3.13, -0.35, 0}, {0, 0, 1}, 0.062, 0.026, b_.pieces(90, 8), b_.pieces(40, 4));
  pen(p_.metal).rod({-3.13, -0.35, -0.04}, {-3.13, -0.35, 0.04}, 0.045, b_.pieces(40, 5));
}

}  // namespace izb::procedural

// SPDX-License-Identifier: MIT
#include "reference/exact.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/parallel.h"

namespace izb::reference {
namespace {

using IntegerVector = std::array<mpz_class, 3>;

// Doubles are integers times powers of two. One common power for all that are subtracted from one another
// leaves every sign below as it is, so integers suffice where the rule speaks of real numbers.
struct Exponent {
  int least = std::numeric_limits<int>::max();
  void include(const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) {
      if (v[i] == 0.0) continue;
      int exponent;
      std::frexp(v[i], &exponent);
      least = std::min(least, exponent - 53);
    }
  }
  IntegerVector scale(const glm::dvec3& v) const {
    IntegerVector scaled;
    for (int i = 0; i < 3; ++i) {
      if (v[i] == 0.0) continue;
      int exponent;
      const double fraction = std::frexp(v[i], &exponent);
      scaled[i] = static_cast<long>(std::ldexp(fraction, 53));
      scaled[i] <<= static_cast<unsigned>(exponent - 53 - least);
    }
    return scaled;
  }
};

IntegerVector operator-(const IntegerVector& u, const IntegerVector& v) {
  return {mpz_class(u[0] - v[0]), mpz_class(u[1] - v[1]), mpz_class(u[2] - v[2])};
}

mpz_class determinant(const IntegerVector& u, const IntegerVector& v, const IntegerVector& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// The sign of a 3x3 determinant whose rows are inputs or single differences of inputs, or nothing where
// rounding could turn it. Shewchuk's bound for this expression is (7 + 56 e) e times the permanent of the
// absolute values, e = 2^-53.
std::optional<int> filtered_sign(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) {
  const double vw_x = v.y * w.z, wv_x = v.z * w.y;
  const double vw_y = v.z * w.x, wv_y = v.x * w.z;
  const double vw_z = v.x * w.y, wv_z = v.y * w.x;
  const double value = u.x * (vw_x - wv_x) + u.y * (vw_y - wv_y) + u.z * (vw_z - wv_z);
  const double permanent = std::abs(u.x) * (std::abs(vw_x) + std::abs(wv_x)) +
                           std::abs(u.y) * (std::abs(vw_y) + std::abs(wv_y)) +
                           std::abs(u.z) * (std::abs(vw_z) + std::abs(wv_z));
  constexpr double bound = 8.0 * 0x1p-53;
  constexpr double underflow = 1e-280;  // far above what products that underflow can lose
  if (value > bound * permanent + underflow) return 1;
  if (value < -bound * permanent - underflow) return -1;
  return std::nullopt;
}

// One question about one point, triangle and light; the integers are made when the first filter fails.
class Question {
 public:
  Question(const glm::dvec3& point, const Corners& triangle, const LightPoint& light)
      : point_(point),
        a_(triangle.a),
        b_(triangle.b),
        c_(triangle.c),
        light_(light.xyz_vs),
        positional_(light.positional),
        to_light_(positional_ ? light_ - point_ : light_) {}

  std::optional<int> den_filtered() const { return filtered_sign(b_ - a_, c_ - a_, to_light_); }
  std::optional<int> edge_filtered(int edge) const {
    const auto [from, to] = edge_ends(edge);
    return filtered_sign(*from - point_, *to - point_, to_light_);
  }

  int den() {
    if (const auto sign = den_filtered()) return *sign;
    const Integers& n = integers();
    return sgn(determinant(n.b - n.a, n.c - n.a, n.to_light));
  }

  int edge(int edge) {
    if (const auto sign = edge_filtered(edge)) return *sign;
    const Integers& n = integers();
    const IntegerVector* corner[3] = {&n.a, &n.b, &n.c};
    return sgn(determinant(*corner[edge] - n.point, *corner[(edge + 1) % 3] - n.point, n.to_light));
  }

  int num() {
    if (const auto sign = filtered_sign(b_ - a_, c_ - a_, a_ - point_)) return *sign;
    const Integers& n = integers();
    return sgn(determinant(n.b - n.a, n.c - n.a, n.a - n.point));
  }

  // det(b-a, c-a, Q-a) = den - num, whose sign is den's iff num / den < 1.
  int light_side() {
    if (const auto sign = filtered_sign(b_ - a_, c_ - a_, light_ - a_)) return *sign;
    const Integers& n = integers();
    return sgn(determinant(n.b - n.a, n.c - n.a, n.light - n.a));
  }

  bool plane_between(int den_sign) {
    return den_sign != 0 && num() == den_sign && (!positional_ || light_side() == den_sign);
  }

 private:
  struct Integers {
    IntegerVector point, a, b, c, light, to_light;
  };

  std::pair<const glm::dvec3*, const glm::dvec3*> edge_ends(int edge) const {
    const glm::dvec3* corner[3] = {&a_, &b_, &c_};
    return {corner[edge], corner[(edge + 1) % 3]};
  }

  const Integers& integers() {
    if (!integers_) {
      Exponent positions;
      for (const glm::dvec3* v : {&point_, &a_, &b_, &c_}) positions.include(*v);
      if (positional_) positions.include(light_);
      Integers n;
      n.point = positions.scale(point_), n.a = positions.scale(a_);
      n.b = positions.scale(b_), n.c = positions.scale(c_);
      if (positional_) {
        n.light = positions.scale(light_);
        n.to_light = n.light - n.point;
      } else {
        Exponent direction;
        direction.include(light_);
        n.to_light = direction.scale(light_);
      }
      integers_ = std::move(n);
    }
    return *integers_;
  }

  glm::dvec3 point_, a_, b_, c_, light_;
  bool positional_;
  glm::dvec3 to_light_;
  std::optional<Integers> integers_;
};

}  // namespace

bool holds_light(const Corners& triangle, const LightPoint& light) {
  if (!light.positional) return false;
  const auto norm1 = [](const glm::vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const double reach = std::max({norm1(triangle.a), norm1(triangle.b), norm1(triangle.c)});
  const double band = double(light.band) + 16.0 * 0x1p-24 * reach;
  const glm::dvec3 n = normal(triangle);
  const double side = glm::dot(n, glm::dvec3(light.xyz_vs) - glm::dvec3(triangle.a));
  return side * side <= band * band * glm::dot(n, n);
}

bool occluded_exact(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light) {
  Question question(point_vs, triangle, light);
  // The three edge values sum to den, so two certain signs that differ already say that the point is outside.
  std::optional<int> known[3];
  for (int i = 0; i < 3; ++i) {
    known[i] = question.edge_filtered(i);
    for (int j = 0; j < i; ++j)
      if (known[i] && known[j] && *known[i] != *known[j]) return false;
  }
  const int den = question.den();
  if (den == 0 || holds_light(triangle, light)) return false;
  for (int i = 0; i < 3; ++i)
    if ((known[i] ? *known[i] : question.edge(i)) == -den) return false;
  return question.plane_between(den);
}

bool plane_between_exact(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light) {
  if (holds_light(triangle, light)) return false;
  Question question(point_vs, triangle, light);
  return question.plane_between(question.den());
}

double plane_distance(const glm::dvec3& point_vs, const Corners& triangle, const LightPoint& light) {
  Question question(point_vs, triangle, light);
  const int sign = question.den() * question.num();
  if (sign == 0) return 0.0;
  const glm::dvec3 across = normal(triangle);
  const double length = glm::length(across);
  return length > 0.0 ? sign * std::abs(glm::dot(across, glm::dvec3(triangle.a) - point_vs)) / length : 0.0;
}

std::vector<uint32_t> exact_mask(const Triangles& triangles, const LightPoint& light, const Receivers& receivers) {
  receivers.check("compute an exact mask");
  std::vector<uint32_t> mask(receivers.count(), 0);
  parallel_for(receivers.count(), 64, 0, [&](size_t begin, size_t end, unsigned) {
    for (size_t i = begin; i < end; ++i) {
      if (receivers.classes[i] != PixelClass::receiver) continue;
      for (int s = 0; s < receivers.sample_count(); ++s) {
        const glm::dvec3 point = receivers.point(i, s);
        for (size_t t = 0; t < triangles.count(); ++t) {
          if (t == receivers.spared(i) || !occluded_exact(point, corners(triangles, t), light)) continue;
          if (triangles.cutouts && !triangles.cutouts->there(t, corners(triangles, t), point, way_to(light, point)))
            continue;
          mask[i] |= receivers.word_of(s);
          break;
        }
      }
    }
  });
  return mask;
}

}  // namespace izb::reference

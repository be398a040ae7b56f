// The 32 bits of a triangle over a micro-quad: by the table, exactly in single precision where that decides, or in double.
// Defines: TABLE: by the look-up table.
#include "shared/coverage.h"
#include "shared/table.h"

layout(std140, binding = BIND_SAMPLES) uniform SampleBlock { SampleFrame samples; };

// The definition, sample by sample.
uint occluded_bits(QuadPlanes planes) {
  uint bits = 0u;
  for (int i = 0; i < 32; ++i)
    if (occluded_sample(planes, samples.offset_px[i].xy)) bits |= 1u << i;
  return bits;
}

// Samples surely on the positive and on the negative side of a line that is off by `error`. With the table they are each
// other's complement, and a line whose error is large against a bin leaves the whole pair unsure.
struct Sides {
  uint above;
  uint below;
};

#ifdef TABLE
layout(binding = UNIT_TABLE) uniform usamplerBuffer visibility_table;

Sides sides_of(vec3 line, float error, inout bool unsure) {
  int side = int(samples.info.y);
  int entry = table_entry(line, side);
  uint bits = texelFetch(visibility_table, clamp(entry, 0, side * side - 1)).x;
  bits = entry == table_all ? 0xffffffffu : (entry == table_none ? 0u : bits);
  float size = abs(line.y) + abs(line.z);
  if (!(error * 128.0 <= size) && !(abs(line.x) > 0.5 * size + error)) unsure = true;
  return Sides(bits, ~bits);
}
#else
Sides sides_of(vec3 line, float error, inout bool unsure) {
  uint above = 0u, below = 0u;
  for (int i = 0; i < 32; ++i) {
    vec2 o = samples.offset_px[i].xy;
    float value = line.x + (o.x * line.y + o.y * line.z);
    above |= value > error ? 1u << i : 0u;
    below |= value < -error ? 1u << i : 0u;
  }
  return Sides(above, below);
}
#endif

Sides edge_sides(EdgePlane e, float vertex_norm1, MicroQuad quad, inout bool unsure) {
  vec3 q = e.first - quad.center;
  return sides_of(quad_line(e.normal, e.turned, q, quad), quad_line_error(e.error, vertex_norm1, q, quad), unsure);
}

// The occluded samples; `unsure`: the answer needs double precision.
uint classify_quad(CameraFrame eye, QuadTriangle t, MicroQuad quad, out bool unsure) {
  bool edges_unsure = false, plane_unsure = false;
  Sides e0 = edge_sides(t.edge0, t.vertex_norm1, quad, edges_unsure);
  Sides e1 = edge_sides(t.edge1, t.vertex_norm1, quad, edges_unsure);
  Sides ac = edge_sides(t.edge2, t.vertex_norm1, quad, edges_unsure);
  Sides e2 = Sides(ac.below, ac.above);
  vec3 q = t.edge0.first - quad.center;
  vec3 height = quad_line(t.plane, t.plane_turned, q, quad);
  float bias = quad_bias(eye, quad.center, quad.t, t.vertex_norm1, quad.overhang);
  height -= bias * vec3(1.0, quad.slope);
  Sides h = sides_of(height, quad_line_error(t.plane_error, t.vertex_norm1, q, quad), plane_unsure);
  if (!t.sided) h = Sides(0u, 0u);

  // One sign on all three edges is inside, two certain and different signs are outside, whatever the winding.
  uint inside = (e0.above & e1.above & e2.above) | (e0.below & e1.below & e2.below);
#ifdef TABLE
  // Two bins may both claim a sample that lies between nearly coincident lines: the triangle's own side decides.
  if (t.sided) inside = t.facing ? e0.above & e1.above & e2.above : e0.below & e1.below & e2.below;
  uint bits = inside & h.above;
  unsure = !t.sided ? inside != 0u : (edges_unsure && h.above != 0u) || (plane_unsure && (inside != 0u || edges_unsure));
  return unsure ? 0u : bits;
#else
  uint outside = (e0.above | e1.above | e2.above) & (e0.below | e1.below | e2.below);
  uint bits = inside & h.above;
  unsure = (bits | outside | h.below) != 0xffffffffu;
  return bits;
#endif
}

// The 32 bits of a triangle over a micro-quad: by the table, exactly in single precision where that decides, or in double.
// Defines: TABLE: by the look-up table.
#include "shared/coverage.h"
#include "shared/table.h"

layout(std140, binding = BIND_SAMPLES) uniform SampleBlock { SampleFrame samples; };

// No loops: llvmpipe ends all loops of an invocation after 65,535 rounds, and the walk needs them.
#define FOUR_SAMPLES(f, i) f(i) f(i + 1) f(i + 2) f(i + 3)
#define FOR_ALL_SAMPLES(f)                                                                                      \
  FOUR_SAMPLES(f, 0) FOUR_SAMPLES(f, 4) FOUR_SAMPLES(f, 8) FOUR_SAMPLES(f, 12) FOUR_SAMPLES(f, 16)              \
  FOUR_SAMPLES(f, 20) FOUR_SAMPLES(f, 24) FOUR_SAMPLES(f, 28)

// The definition, sample by sample.
#define ADD_OCCLUDED(i) bits |= occluded_sample(planes, samples.offset_px[i].xy) ? 1u << (i) : 0u;
uint occluded_bits(QuadPlanes planes) {
  uint bits = 0u;
  FOR_ALL_SAMPLES(ADD_OCCLUDED)
  return bits;
}

#ifdef TABLE
layout(binding = UNIT_TABLE) uniform usamplerBuffer visibility_table;

// The samples on the positive side of a line, by the table. `unknown`: all bits where the line is off by more than half a bin
// of the default table and crosses the pixel, else 0.
uint table_bits(vec3 line, float error, out uint unknown) {
  float size = abs(line.y) + abs(line.z);
  unknown = error * 128.0 <= size || abs(line.x) > 0.5 * size + error ? 0u : 0xffffffffu;
  return texelFetch(visibility_table, table_entry(line, int(samples.info.y))).x;
}

uint edge_bits(EdgePlane e, float vertex_norm1, MicroQuad quad, out uint unknown) {
  vec3 q = e.first - quad.center;
  return table_bits(quad_line(e.normal, e.turned, q, quad), quad_line_error(e.error, vertex_norm1, q, quad), unknown);
}

// The occluded samples; `unsure`: the answer needs double precision.
uint classify_quad(CameraFrame eye, QuadTriangle t, MicroQuad quad, out bool unsure) {
  uint u0, u1, u2, uh;
  uint ab = edge_bits(t.edge0, t.vertex_norm1, quad, u0);
  uint bc = edge_bits(t.edge1, t.vertex_norm1, quad, u1);
  uint ca = ~edge_bits(t.edge2, t.vertex_norm1, quad, u2);
  vec3 q = t.edge0.first - quad.center;
  vec4 height = quad_height(eye, t, q, quad);
  uint above = table_bits(height.xyz, height.w, uh);

  // Each edge's bits are the other triangle's complement, so the triangle's own side decides what is inside. What is unknown
  // may be; where nothing is left all the same, nothing is unsure.
  uint inside = 0u;
  if (t.facing || !t.sided) inside |= (ab | u0) & (bc | u1) & (ca | u2);
  if (!t.facing || !t.sided) inside |= (~ab | u0) & (~bc | u1) & (~ca | u2);
  if (!t.sided) uh = 0xffffffffu;
  uint bits = inside & (above | uh);
  unsure = bits != 0u && (u0 | u1 | u2 | uh) != 0u;
  return unsure ? 0u : bits;
}
#else
// Samples surely on the positive and on the negative side of a line that is off by `error`.
struct Sides {
  uint above;
  uint below;
};

#define ADD_SIDE(i)                                                                      \
  {                                                                                      \
    float value = line.x + (samples.offset_px[i].x * line.y + samples.offset_px[i].y * line.z); \
    above |= value > error ? 1u << (i) : 0u;                                             \
    below |= value < -error ? 1u << (i) : 0u;                                            \
  }

Sides sides_of(vec3 line, float error) {
  uint above = 0u, below = 0u;
  FOR_ALL_SAMPLES(ADD_SIDE)
  return Sides(above, below);
}

Sides edge_sides(EdgePlane e, float vertex_norm1, MicroQuad quad) {
  vec3 q = e.first - quad.center;
  return sides_of(quad_line(e.normal, e.turned, q, quad), quad_line_error(e.error, vertex_norm1, q, quad));
}

// The occluded samples; `unsure`: the answer needs double precision.
uint classify_quad(CameraFrame eye, QuadTriangle t, MicroQuad quad, out bool unsure) {
  Sides ab = edge_sides(t.edge0, t.vertex_norm1, quad);
  Sides bc = edge_sides(t.edge1, t.vertex_norm1, quad);
  Sides ac = edge_sides(t.edge2, t.vertex_norm1, quad);
  Sides ca = Sides(ac.below, ac.above);
  vec3 q = t.edge0.first - quad.center;
  vec4 height = quad_height(eye, t, q, quad);
  Sides h = sides_of(height.xyz, height.w);
  if (!t.sided) h = Sides(0u, 0u);

  // One sign on all three edges is inside, two certain and different signs are outside, whatever the winding.
  uint inside = (ab.above & bc.above & ca.above) | (ab.below & bc.below & ca.below);
  uint outside = (ab.above | bc.above | ca.above) & (ab.below | bc.below | ca.below);
  uint bits = inside & h.above;
  unsure = (bits | outside | h.below) != 0xffffffffu;
  return bits;
}
#endif

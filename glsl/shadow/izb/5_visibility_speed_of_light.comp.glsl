#version 450 core
// 5.5 The paper's speed of light (its table 2): one stored test an invocation, without grid, raster and lists. Defines, beside
// those of pair_test.glsl: MASKED: some of the triangles have an alpha mask, which each test asks.
#include "shared/bindings.h"
#include "shadow/izb/numbered_triangle.glsl"

layout(local_size_x = 64) in;

layout(location = 0) uniform int test_count;

layout(binding = UNIT_TESTS) uniform usampler2D stored_tests;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.y * tests_a_row + texel.x >= test_count) return;
  uvec2 stored = texelFetch(stored_tests, texel, 0).xy;
  ivec2 px = stored_pixel(stored);
  uvec2 id = stored_id(stored);
  CameraFrame eye = camera;
  bool unsure;
  uint bits = test(eye, numbered_triangle(eye, id.x - 1u, id.y), px, load_data(px), unsure);
  if (bits != 0u) add_shadow(px, bits);
  if (unsure) add_pair(px, id);
}

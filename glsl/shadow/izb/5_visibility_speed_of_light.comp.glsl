#version 450 core
// 5.5 The paper's speed of light (its table 2): one stored test an invocation, without grid, raster and lists. Defines, beside
// those of pair_test.glsl: MASKED: some of the triangles have an alpha mask, which each test asks.
#include "shared/bindings.h"
#include "shared/geometry.glsl"
#include "shadow/izb/pair_test.glsl"
#ifdef MASKED
#include "shared/uvs.glsl"
#endif

layout(local_size_x = 64) in;

layout(location = 0) uniform int test_count;

layout(binding = UNIT_TESTS) uniform usampler2D stored_tests;

Triangle triangle_of(CameraFrame eye, uint instance, uint number) {
  vec3 corners[3] = triangle_vs(instance, number);
#ifdef MASKED
  uint material = instances[instance].info.y;
  if (is_masked(materials[material])) {
    vec2 uv[3] = triangle_uvs(instance, number);
#ifdef SPP32
    order_with_uvs(corners[0], corners[1], corners[2], uv[0], uv[1], uv[2]);
#endif
    return make_triangle(eye, corners[0], corners[1], corners[2], make_cutout(material, uv[0], uv[1], uv[2]));
  }
#endif
#ifdef SPP32
  order_vertices(corners[0], corners[1], corners[2]);
#endif
  return make_triangle(eye, corners[0], corners[1], corners[2]);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.y * tests_a_row + texel.x >= test_count) return;
  uvec2 stored = texelFetch(stored_tests, texel, 0).xy;
  ivec2 px = stored_pixel(stored);
  uvec2 id = stored_id(stored);
  CameraFrame eye = camera;
  bool unsure;
  uint bits = test(eye, triangle_of(eye, id.x - 1u, id.y), px, load_data(px), unsure);
  if (bits != 0u) add_shadow(px, bits);
  if (unsure) add_pair(px, id);
}

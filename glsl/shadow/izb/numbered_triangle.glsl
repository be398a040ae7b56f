// A triangle by its numbers, as the test takes it. MASKED: it may have an alpha mask.
#include "shared/geometry.glsl"
#include "shadow/izb/pair_test.glsl"
#ifdef MASKED
#include "shared/uvs.glsl"
#endif

Triangle numbered_triangle(CameraFrame eye, uint instance, uint number) {
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

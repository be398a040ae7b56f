#version 450 core
// 5.1 Which triangle the pixel sees, and what shading needs. The receiver point follows in 1_gbuffer_resolve.
// MASKED: through an alpha mask's holes it sees what is behind; the mask is asked where the pixel's ray meets the triangle.
#include "shared/bindings.h"
#include "shared/camera.h"

layout(location = 0) in vec3 v_normal_vs;
layout(location = 1) in vec2 v_uv;
layout(location = 2) flat in uint v_instance;
layout(location = 3) flat in vec3 v_base_color;

#ifdef MASKED
#include "shared/alpha.glsl"
#include "shared/geometry.glsl"
#include "shared/uvs.glsl"

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };

bool is_hole() {
  uint triangle = uint(gl_PrimitiveID);
  vec3 corners[3] = triangle_vs(v_instance, triangle);
  vec2 uv[3] = triangle_uvs(v_instance, triangle);
  Cutout cutout = make_cutout(instances[v_instance].info.y, uv[0], uv[1], uv[2]);
  dvec3 weights = camera_weights(camera, floor(gl_FragCoord.xy) + 0.5, corners[0], corners[1], corners[2]);
  return !is_there(cutout.map, texel_of_weights(cutout.corners, weights));
}
#else
layout(early_fragment_tests) in;
#endif

layout(binding = UNIT_BASE_COLOR) uniform sampler2D base_color_texture;

layout(location = 0) out uvec2 out_id;              // instance + 1 (0: sky), triangle of the instance's mesh
layout(location = 1) out vec4 out_albedo;           // linear; a: 1 with a shading normal, 1/2 without
layout(location = 2) out vec2 out_shading_normal;   // octahedral, in [0, 1]

void main() {
  vec3 color = texture(base_color_texture, v_uv).rgb * v_base_color;
#ifdef MASKED
  if (is_hole()) discard;
#endif
  float length2 = dot(v_normal_vs, v_normal_vs);
  out_id = uvec2(v_instance + 1u, uint(gl_PrimitiveID));
  out_albedo = vec4(color, length2 > 0.0 ? 1.0 : 0.5);
  out_shading_normal = 0.5 + 0.5 * (length2 > 0.0 ? octahedral_encode(v_normal_vs * inversesqrt(length2)) : vec2(0.0));
}

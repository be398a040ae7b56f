#version 450 core
// 5.1 The receiver point of each pixel: its ray against the plane of the triangle that it sees. MICRO_QUAD: and the
// micro-quad around it.
#include "shared/bindings.h"
#include "shared/gbuffer.h"
#include "shared/geometry.glsl"
#include "shared/micro_quad.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(binding = UNIT_ID) uniform usampler2D id_texture;
layout(binding = IMAGE_EYE_DISTANCE, r32f) writeonly uniform image2D eye_distance_image;
layout(binding = IMAGE_NORMAL, rg32f) writeonly uniform image2D normal_image;
#ifdef MICRO_QUAD
layout(binding = IMAGE_MICRO_QUAD, rgba32f) writeonly uniform image2D micro_quad_image;
#endif

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  if (px.x >= int(camera.size_px.x) || px.y >= int(camera.size_px.y)) return;
  uvec2 id = texelFetch(id_texture, px, 0).xy;
  float eye_distance = 0.0;
  vec2 normal = vec2(0.0);
  vec4 micro_quad = vec4(0.0);
  if (id.x != 0u) {
    vec3 corners[3] = triangle_vs(id.x - 1u, id.y);
    ReceiverPlane r = intersect_plane(camera, vec2(px) + 0.5, corners[0], corners[1], corners[2]);
    eye_distance = r.eye_distance;
#ifdef MICRO_QUAD
    micro_quad = micro_quad_data(camera, vec2(px) + 0.5, r.eye_distance, corners[0], corners[1], corners[2]);
#endif
    normal = r.on_plane ? octahedral_encode(r.normal_vs) : octahedral_none();
  }
  imageStore(eye_distance_image, px, vec4(eye_distance));
#ifdef MICRO_QUAD
  imageStore(micro_quad_image, px, micro_quad);
#endif
  imageStore(normal_image, px, vec4(normal, 0.0, 0.0));
}

#version 450 core
// 5.1, not in the paper: lifts micro-quads out of concave surfaces, see shared/lift.h.
#include "shared/bindings.h"
#include "shared/lift.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = IMAGE_MICRO_QUAD, rgba32f) uniform image2D micro_quad_image;

vec3 normal_at(ivec2 px) { return octahedral_decode(texelFetch(normal_texture, px, 0).xy); }

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  ivec2 last = ivec2(camera.size_px.xy) - 1;
  if (px.x > last.x || px.y > last.y) return;
  float t = texelFetch(eye_distance_texture, px, 0).x;
  if (!(t > 0.0)) return;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
  vec3 normal = normal_at(px);
  float most = pixel_width(camera, t);
  float rise = 0.0;
  for (int i = 0; i < 9; ++i) {
    if (i == 4) continue;
    ivec2 at = clamp(px + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last);
    float its = texelFetch(eye_distance_texture, at, 0).x;
    vec3 way = receiver_point(camera, vec2(at) + 0.5, its) - p;
    float its_rise = dot(normal, way);
    // On a flat surface that is all.
    if (its > 0.0 && its_rise > rise && is_rise(its_rise, p, most) && bends_up(way, its_rise, normal, normal_at(at)))
      rise = its_rise;
  }
  if (!(rise > 0.0)) return;
  vec4 data = imageLoad(micro_quad_image, px);
  data.x = lifted_distance(camera, p, normal, t, rise);
  imageStore(micro_quad_image, px, data);
}

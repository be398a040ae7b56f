#version 450 core
// 5.2 Scene bounds: what the receivers span as the light sees them. Persistent threads over the z-buffer, each with its
// own extremes, joined by atomics at the end.
#include "shared/bindings.h"
#include "shared/insertion.h"

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_BOUNDS) buffer BoundsBlock { ReceiverBounds all_bounds[max_cascades]; };
layout(std430, binding = BIND_CASCADES) readonly buffer CascadeBlock { CascadeRange range; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;

void main() {
  // Read once, not in every round of the loop.
  CameraFrame eye = camera;
  LightFrame lamp = light;
  vec3 low = vec3(3.0e38), high = vec3(-3.0e38);
  float uv_slack = 0.0, d_slack = 0.0;
  uint receivers = 0u;
  int cascade = int(gl_WorkGroupID.z), cascades = int(lamp.grid.y);
  for (uint y = gl_WorkGroupID.x; y < eye.size_px.y; y += gl_NumWorkGroups.x)
    for (uint x = gl_LocalInvocationID.x; x < eye.size_px.x; x += gl_WorkGroupSize.x) {
      ivec2 px = ivec2(x, y);
      float t = texelFetch(eye_distance_texture, px, 0).x;
      vec3 p = receiver_point(eye, vec2(px) + 0.5, t);
      vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
      if (t > 0.0 && receiver_class(lamp, p, normal) == class_receiver &&
          (cascades == 1 || cascade_of(range, cascades, t) == cascade)) {
        vec3 p_ls = light_position(lamp, p);
#ifdef MICRO_QUAD
        MicroQuad quad = make_micro_quad(eye, px, texelFetch(micro_quad_texture, px, 0));
        for (int i = 0; i < 4; ++i) {
          vec3 uvd = micro_quad_uvd(lamp, quad, corner_offset(i));
          low = min(low, uvd);
          high = max(high, uvd);
        }
        uv_slack = max(uv_slack, quad_uv_error(lamp, quad, p_ls));
        d_slack = max(d_slack, quad_d_error(lamp, quad, p_ls));
#else
        vec3 uvd = light_uvd(lamp, p_ls);
        low = min(low, uvd);
        high = max(high, uvd);
        uv_slack = max(uv_slack, uv_error(lamp, p, p_ls));
        d_slack = max(d_slack, d_error(lamp, p, p_ls));
#endif
        ++receivers;
      }
    }
  if (receivers == 0u) return;
  atomicMin(all_bounds[cascade].low.x, ordered_from_float(low.x));
  atomicMin(all_bounds[cascade].low.y, ordered_from_float(low.y));
  atomicMin(all_bounds[cascade].low.z, ordered_from_float(low.z));
  atomicMax(all_bounds[cascade].high.x, ordered_from_float(high.x));
  atomicMax(all_bounds[cascade].high.y, ordered_from_float(high.y));
  atomicMax(all_bounds[cascade].high.z, ordered_from_float(high.z));
  atomicMax(all_bounds[cascade].slack.x, ordered_from_float(uv_slack));
  atomicMax(all_bounds[cascade].slack.y, ordered_from_float(d_slack));
  atomicAdd(all_bounds[cascade].slack.z, receivers);
}

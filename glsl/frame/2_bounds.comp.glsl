#version 450 core
// 5.2 Scene bounds: what the receivers span as the light sees them. Persistent threads over the z-buffer, each with its
// own extremes, joined by atomics at the end.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_BOUNDS) buffer BoundsBlock { ReceiverBounds bounds; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;

void main() {
  // Read once, not in every round of the loop.
  CameraFrame eye = camera;
  LightFrame lamp = light;
  vec3 low = vec3(3.0e38), high = vec3(-3.0e38);
  float uv_slack = 0.0, d_slack = 0.0;
  uint receivers = 0u;
  for (uint y = gl_WorkGroupID.x; y < eye.size_px.y; y += gl_NumWorkGroups.x)
    for (uint x = gl_LocalInvocationID.x; x < eye.size_px.x; x += gl_WorkGroupSize.x) {
      ivec2 px = ivec2(x, y);
      float t = texelFetch(eye_distance_texture, px, 0).x;
      vec3 p = receiver_point(eye, vec2(px) + 0.5, t);
      vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
      if (t > 0.0 && receiver_class(lamp, p, normal) == class_receiver) {
        vec3 p_ls = light_position(lamp, p);
        vec3 uvd = light_uvd(lamp, p_ls);
        low = min(low, uvd);
        high = max(high, uvd);
        uv_slack = max(uv_slack, uv_error(lamp, p, p_ls));
        d_slack = max(d_slack, d_error(lamp, p, p_ls));
        ++receivers;
      }
    }
  if (receivers == 0u) return;
  atomicMin(bounds.low.x, ordered_from_float(low.x));
  atomicMin(bounds.low.y, ordered_from_float(low.y));
  atomicMin(bounds.low.z, ordered_from_float(low.z));
  atomicMax(bounds.high.x, ordered_from_float(high.x));
  atomicMax(bounds.high.y, ordered_from_float(high.y));
  atomicMax(bounds.high.z, ordered_from_float(high.z));
  atomicMax(bounds.slack.x, ordered_from_float(uv_slack));
  atomicMax(bounds.slack.y, ordered_from_float(d_slack));
  atomicAdd(bounds.slack.z, receivers);
}

// The frame's receivers, shared out among persistent threads. Whoever includes this declares `Gathered` before, and defines
// what each receiver adds to it.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = 64) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;

void visit(CameraFrame eye, LightFrame lamp, ivec2 px, float t, vec3 p, inout Gathered gathered);

void for_each_receiver(inout Gathered gathered) {
  // Read once, not in every round of the loop.
  CameraFrame eye = camera;
  LightFrame lamp = light;
  for (uint y = gl_WorkGroupID.x; y < eye.size_px.y; y += gl_NumWorkGroups.x)
    for (uint x = gl_LocalInvocationID.x; x < eye.size_px.x; x += gl_WorkGroupSize.x) {
      ivec2 px = ivec2(x, y);
      float t = texelFetch(eye_distance_texture, px, 0).x;
      vec3 p = receiver_point(eye, vec2(px) + 0.5, t);
      vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
      if (t > 0.0 && receiver_class(lamp, p, normal) == class_receiver) visit(eye, lamp, px, t, p, gathered);
    }
}

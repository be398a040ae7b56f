#version 450 core
// 5.6 What the bound light brings, unhidden, to points all over the picture: light after light is added.
#include "shared/bindings.h"
#include "shared/light.h"
#include "shared/shade.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_SHADE) uniform ShadeBlock { ShadeFrame shade; };
layout(std430, binding = BIND_METER) buffer MeterBlock { float brought[]; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  ivec2 px = ivec2((vec2(at) + 0.5) * vec2(camera.size_px.xy) / float(meter_side));
  float t = texelFetch(eye_distance_texture, px, 0).x;
  if (!(t > 0.0)) return;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
  LightFrame culling = light;
  culling.color.w = 1.0;
  if (receiver_class(culling, p, octahedral_direction(texelFetch(normal_texture, px, 0).xy)) != class_receiver) return;
  brought[at.y * meter_side + at.x] += arriving_light(light, shade, p);
}

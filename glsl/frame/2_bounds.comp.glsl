#version 450 core
// 5.2 Scene bounds: what the receivers of each of CASCADES span as the light sees them. Each thread has its own extremes,
// joined by atomics at the end.
struct Extremes {
  vec3 low, high;
  vec2 slack;  // of u and v, of d
  uint receivers;
};
struct Gathered {
  Extremes of[CASCADES];
};
#include "frame/for_each_receiver.glsl"
#include "shared/insertion.h"

layout(std430, binding = BIND_BOUNDS) buffer BoundsBlock { ReceiverBounds all_bounds[max_cascades]; };
layout(std430, binding = BIND_CASCADES) readonly buffer CascadeBlock { CascadeRange range; };
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;

void visit(CameraFrame eye, LightFrame lamp, ivec2 px, float t, vec3 p, inout Gathered gathered) {
  vec3 p_ls = light_position(lamp, p);
#ifdef MICRO_QUAD
  MicroQuad quad = make_micro_quad(eye, px, texelFetch(micro_quad_texture, px, 0));
  vec3 low = micro_quad_uvd(lamp, quad, corner_offset(0)), high = low;
  for (int i = 1; i < 4; ++i) {
    vec3 uvd = micro_quad_uvd(lamp, quad, corner_offset(i));
    low = min(low, uvd);
    high = max(high, uvd);
  }
  vec2 slack = vec2(quad_uv_error(lamp, quad, p_ls), quad_d_error(lamp, quad, p_ls));
#else
  vec3 low = light_uvd(lamp, p_ls), high = low;
  vec2 slack = vec2(uv_error(lamp, p, p_ls), d_error(lamp, p, p_ls));
#endif
  int cascade = CASCADES == 1 ? 0 : cascade_of(range, CASCADES, t);
  // With constant indices the extremes stay in registers.
  for (int i = 0; i < CASCADES; ++i)
    if (i == cascade) {
      gathered.of[i].low = min(gathered.of[i].low, low);
      gathered.of[i].high = max(gathered.of[i].high, high);
      gathered.of[i].slack = max(gathered.of[i].slack, slack);
      ++gathered.of[i].receivers;
    }
}

void main() {
  Gathered gathered;
  for (int i = 0; i < CASCADES; ++i) gathered.of[i] = Extremes(vec3(3.0e38), vec3(-3.0e38), vec2(0.0), 0u);
  for_each_receiver(gathered);
  for (int i = 0; i < CASCADES; ++i) {
    Extremes extremes = gathered.of[i];
    if (extremes.receivers == 0u) continue;
    atomicMin(all_bounds[i].low.x, ordered_from_float(extremes.low.x));
    atomicMin(all_bounds[i].low.y, ordered_from_float(extremes.low.y));
    atomicMin(all_bounds[i].low.z, ordered_from_float(extremes.low.z));
    atomicMax(all_bounds[i].high.x, ordered_from_float(extremes.high.x));
    atomicMax(all_bounds[i].high.y, ordered_from_float(extremes.high.y));
    atomicMax(all_bounds[i].high.z, ordered_from_float(extremes.high.z));
    atomicMax(all_bounds[i].slack.x, ordered_from_float(extremes.slack.x));
    atomicMax(all_bounds[i].slack.y, ordered_from_float(extremes.slack.y));
    atomicAdd(all_bounds[i].slack.z, extremes.receivers);
  }
}

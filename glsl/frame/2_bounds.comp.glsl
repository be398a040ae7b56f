#version 450 core
// 5.2 Scene bounds: what the receivers of each of LAYERS span as the light sees them, from first_layer on. Each thread has
// its own extremes, joined by atomics at the end. Defines: CASCADES; MICRO_QUAD: the whole of it counts; CUBE: six faces of
// so many.
struct Extremes {
  vec3 low, high;
  vec2 slack;  // of u and v, of d
  uint receivers;
};
struct Gathered {
  Extremes of[LAYERS];
};
#include "frame/for_each_receiver.glsl"
#include "shared/faces.h"

layout(std430, binding = BIND_BOUNDS) buffer BoundsBlock { ReceiverBounds all_bounds[max_layers]; };
layout(std430, binding = BIND_CASCADES) readonly buffer CascadeBlock { CascadeRange range; };
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
#ifdef CUBE
layout(location = 0) uniform int first_layer;
#else
const int first_layer = 0;
#endif

void add(QuadPart part, int layer, inout Gathered gathered) {
  // With constant indices the extremes stay in registers.
  for (int i = 0; i < LAYERS; ++i)
    if (first_layer + i == layer) {
      gathered.of[i].low = min(gathered.of[i].low, part.low);
      gathered.of[i].high = max(gathered.of[i].high, part.high);
      gathered.of[i].slack = max(gathered.of[i].slack, part.slack);
      ++gathered.of[i].receivers;
    }
}

void visit(CameraFrame eye, LightFrame lamp, ivec2 px, float t, vec3 p, inout Gathered gathered) {
  int cascade = CASCADES == 1 ? 0 : cascade_of(range, CASCADES, t);
  int face = 0;
#ifdef CUBE
  face = face_of(light_position(lamp, p));
#endif
#ifdef MICRO_QUAD
  MicroQuad quad = make_micro_quad(eye, px, texelFetch(micro_quad_texture, px, 0));
#ifdef CUBE
  for (int i = 0; i < cube_faces; ++i) {
    QuadPart part = quad_part(lamp, quad, face);
    if (part.any) add(part, face * CASCADES + cascade, gathered);
    if (part.whole) break;
    face = face == cube_faces - 1 ? 0 : face + 1;
  }
#else
  add(whole_quad(lamp, quad), cascade, gathered);
#endif
#else
  LightFrame its = light_face(lamp, face);
  vec3 p_ls = light_position(its, p);
  vec3 uvd = light_uvd(its, p_ls);
  add(QuadPart(true, true, uvd, uvd, vec2(uv_error(its, p, p_ls), d_error(its, p, p_ls))), face * CASCADES + cascade,
      gathered);
#endif
}

void main() {
  Gathered gathered;
  for (int i = 0; i < LAYERS; ++i) gathered.of[i] = Extremes(vec3(3.0e38), vec3(-3.0e38), vec2(0.0), 0u);
  for_each_receiver(gathered);
  for (int i = 0; i < LAYERS; ++i) {
    Extremes extremes = gathered.of[i];
    if (extremes.receivers == 0u) continue;
    int layer = first_layer + i;
    atomicMin(all_bounds[layer].low.x, ordered_from_float(extremes.low.x));
    atomicMin(all_bounds[layer].low.y, ordered_from_float(extremes.low.y));
    atomicMin(all_bounds[layer].low.z, ordered_from_float(extremes.low.z));
    atomicMax(all_bounds[layer].high.x, ordered_from_float(extremes.high.x));
    atomicMax(all_bounds[layer].high.y, ordered_from_float(extremes.high.y));
    atomicMax(all_bounds[layer].high.z, ordered_from_float(extremes.high.z));
    atomicMax(all_bounds[layer].slack.x, ordered_from_float(extremes.slack.x));
    atomicMax(all_bounds[layer].slack.y, ordered_from_float(extremes.slack.y));
    atomicAdd(all_bounds[layer].slack.z, extremes.receivers);
  }
}

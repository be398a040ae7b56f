#version 450 core
// Each pixel's shadow by the depth map: percentage-closer filtering (Reeves et al. 1987), of which bits are made. One sample
// a pixel: of 32 bits as many are set as the filter's share of shadow asks for. SPP32: each bit is asked at its own sample.
// Filters: TAPS: points of a disc, a texel each; PCF: hardware's 2 x 2; neither: the receiver's own texel. COUNT: counts.
#include "shared/bindings.h"
#include "shared/depth_map.h"
#include "shared/micro_quad.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
layout(std140, binding = BIND_CASCADE_ENDS) uniform CascadeBlock { CascadeRange range; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;
#ifdef PCF
layout(binding = UNIT_DEPTH_MAP) uniform sampler2DArrayShadow depth_map;
#else
layout(binding = UNIT_DEPTH_MAP) uniform sampler2DArray depth_map;
#endif
#ifdef SPP32
layout(std140, binding = BIND_SAMPLES) uniform SampleBlock { SampleFrame samples; };
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
#endif
layout(binding = IMAGE_MASK, r32ui) writeonly uniform uimage2D mask;
layout(location = 1) uniform float margin;  // texels
layout(location = 2) uniform vec4 bias_options;
#ifdef TAPS
layout(location = 3) uniform vec2 taps[TAPS];  // texels from the receiver
#endif
#ifdef COUNT
layout(std430, binding = BIND_COUNTERS) buffer MapCounterBlock { MapCounters counters; };
#endif

void count(uint looked_up, uint comparisons, uint outside) {
#ifdef COUNT
  atomicAdd(counters.receivers, looked_up);
  atomicAdd(counters.comparisons, comparisons);
  atomicAdd(counters.outside, outside);
#endif
}

MapBias map_bias() { return MapBias(bias_options.x, bias_options.y, bias_options.z, bias_options.w); }

#ifdef PCF
// The share of the four texels around it that shadow it, by their distances.
float shadow_share(MapReceiver r, int layer) {
  float reference = map_reference(r, map_bias(), r.at);
  return 1.0 - texture(depth_map, vec4(r.at / float(light.grid.x), layer, reference));
}
#else
bool is_shadowed(MapReceiver r, int layer, vec2 offset) {
  ivec2 texel = clamp(ivec2(floor(r.at + offset)), ivec2(0), ivec2(light.grid.x) - 1);
  return texelFetch(depth_map, ivec3(texel, layer), 0).x < map_reference(r, map_bias(), vec2(texel) + 0.5);
}
#endif

// The word of a pixel's only sample.
uint filtered_word(MapReceiver r, int layer) {
#ifdef PCF
  count(1u, 4u, 0u);
  int bits = int(shadow_share(r, layer) * 32.0 + 0.5);
  return bits == 0 ? 0u : 0xffffffffu >> (32 - bits);
#elif defined(TAPS)
  count(1u, TAPS, 0u);
  const int bits_a_tap = 32 / TAPS;
  const uint bits = 0xffffffffu >> (32 - bits_a_tap);
  uint word = 0u;
  for (int i = 0; i < TAPS; ++i)
    if (is_shadowed(r, layer, taps[i])) word |= bits << (i * bits_a_tap);
  return word;
#else
  count(1u, 1u, 0u);
  return is_shadowed(r, layer, vec2(0.0)) ? 0xffffffffu : 0u;
#endif
}

// Of one sample among 32: each takes another point of the filter, or another threshold of its share, in an order that has
// nothing to do with where the samples lie.
bool sampled_bit(MapReceiver r, int layer, int s) {
  int turn = (s * 13 + 7) & 31;
#ifdef PCF
  count(1u, 4u, 0u);
  return shadow_share(r, layer) > (float(turn) + 0.5) / 32.0;
#elif defined(TAPS)
  count(1u, 1u, 0u);
  return is_shadowed(r, layer, taps[turn % TAPS]);
#else
  count(1u, 1u, 0u);
  return is_shadowed(r, layer, vec2(0.0));
#endif
}

// Where a point falls. False: beyond the map.
bool find(vec3 p, vec3 normal, int cascade, out MapReceiver r, out int layer) {
  int face = light.grid.z > 1u ? face_of(light_position(light, p)) : 0;
  layer = face * int(light.grid.y) + cascade;
  LightWindow window = with_margin(windows[layer], margin);
  r = make_map_receiver(light_face(light, face), window, map_bias(), p, normal);
  bool found = window.guard.y != 0.0 && is_on_map(r, float(light.grid.x));
  if (!found) count(1u, 0u, 1u);
  return found;
}

uint visibility_word(ivec2 px) {
  float t = texelFetch(eye_distance_texture, px, 0).x;
  if (!(t > 0.0)) return 0u;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
  vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
  if (receiver_class(light, p, normal) != class_receiver) return 0u;
  normal = normalize(normal);
  int cascade = cascade_of(range, int(light.grid.y), t);
  MapReceiver r;
  int layer;
#ifdef SPP32
  MicroQuad quad = make_micro_quad(camera, px, texelFetch(micro_quad_texture, px, 0));
  uint word = 0u;
  for (int s = 0; s < 32; ++s)
    if (find(micro_quad_point(quad, samples.offset_px[s].xy), normal, cascade, r, layer) && sampled_bit(r, layer, s))
      word |= 1u << s;
  return word;
#else
  return find(p, normal, cascade, r, layer) ? filtered_word(r, layer) : 0u;
#endif
}

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  if (px.x >= int(camera.size_px.x) || px.y >= int(camera.size_px.y)) return;
  imageStore(mask, px, uvec4(visibility_word(px)));
}

#version 450 core
// 5.5 Conservative rasterisation by dilation: the triangle's footprint on the light-space grid, with its vertices for the
// test in the fragment shader. LAYERS: into those of [first, end) in `layers`, at most LAYERS of them (6.4).
// REST: only what 5_visibility_hw.geom.glsl leaves.
layout(triangles) in;
#include "shadow/izb/vertices.glsl"
#include "shared/footprint.h"
#include "shared/occlusion.h"
#include "shared/pyramid.h"

#ifdef LAYERS
layout(triangle_strip, max_vertices = 4 * LAYERS) out;
layout(location = 2) uniform ivec2 layers;
#else
layout(triangle_strip, max_vertices = 4) out;
#endif
layout(location = 1) uniform float dilation;  // texels
#ifdef REST
layout(location = 3) uniform float hardware_square;  // half the side, texels
#endif

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };

layout(location = 3) flat out vec4 g_box;
#ifdef PYRAMID
layout(binding = UNIT_PYRAMID) uniform usampler2DArray pyramid;

// Is no receiver of the texels that the footprint can touch behind it?
bool behind_all(Footprint f, int layer) {
  vec2 size = f.box.zw - f.box.xy;
  float largest = max(size.x, size.y);
  int k = 0;
  for (float texels = 4.0; texels < largest && k < pyramid_levels - 1; texels *= 4.0) ++k;
  int log_texels = 2 * (k + 1);
  ivec2 last = ivec2(int(light.grid.x) - 1) >> log_texels;
  ivec2 origin = pyramid_origin(int(light.grid.x), k);
  ivec2 low = origin + clamp(ivec2(floor(f.box.xy)) >> log_texels, ivec2(0), last);
  ivec2 high = origin + clamp(ivec2(floor(f.box.zw)) >> log_texels, ivec2(0), last);
  uint furthest = max(max(texelFetch(pyramid, ivec3(low, layer), 0).x, texelFetch(pyramid, ivec3(high, layer), 0).x),
                      max(texelFetch(pyramid, ivec3(low.x, high.y, layer), 0).x,
                          texelFetch(pyramid, ivec3(high.x, low.y, layer), 0).x));
  float nearest = min(min(f.p0.z, f.p1.z), f.count == 4 ? min(f.p2.z, f.p3.z) : f.p2.z);
  return max(nearest, 0.0) >= uintBitsToFloat(furthest);
}
#endif

void emit(vec3 corner, Footprint f, Vertices v, int layer) {
  gl_Position = vec4(corner.xy * (2.0 / float(light.grid.x)) - 1.0, corner.z, 1.0);
  hand_over(v);
  g_box = f.box;
  g_id = uvec2(v_instance[0] + 1u, uint(gl_PrimitiveIDIn));
#ifdef LAYERS
  gl_Layer = layer;
#endif
  EmitVertex();
}

void spawn(Vertices v, int layer) {
#ifdef CUBE
  LightFrame face = light_face(light, layer / int(light.grid.y));
#else
  LightFrame face = light;
#endif
  Footprint f = make_footprint(face, windows[layer], v.a, v.b, v.c, dilation);
  if (f.count == 0) return;
#ifdef REST
  if (f.square <= hardware_square) return;
#endif
#ifdef PYRAMID
  if (behind_all(f, layer)) return;
#endif
#ifdef COUNT
  atomicAdd(counters.triangles, 1u);
#endif
  emit(f.p0, f, v, layer);
  emit(f.p1, f, v, layer);
  emit(f.p2, f, v, layer);
  if (f.count == 4) emit(f.p3, f, v, layer);
  EndPrimitive();
}

void main() {
  if (holds_light(light, v_position_vs[0], v_position_vs[1], v_position_vs[2])) return;
  Vertices v = make_vertices();
#ifdef LAYERS
  for (int layer = layers.x; layer < layers.y; ++layer)
    if (windows[layer].guard.y != 0.0) spawn(v, layer);  // a face that no receiver is seen through costs nothing
#else
  spawn(v, 0);
#endif
}

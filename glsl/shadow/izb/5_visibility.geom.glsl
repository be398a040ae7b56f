#version 450 core
// 5.5 Conservative rasterisation by dilation: the triangle's footprint on the light-space grid, with its vertices for the
// test in the fragment shader. LAYERS: into those of [first, end) in `layers`, at most LAYERS of them (6.4).
// REST: only what 5_visibility_hw.geom.glsl leaves. PULL: only what 5_visibility.comp.glsl leaves, into the layer of each.
layout(triangles) in;
#include "shadow/izb/vertices.glsl"
#include "shared/footprint.h"
#include "shared/occlusion.h"

#if defined(LAYERS) && !defined(PULL)
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
#include "shadow/izb/behind_all.glsl"
#endif

void emit(vec3 corner, Footprint f, Vertices v, int layer) {
  gl_Position = vec4(corner.xy * (2.0 / float(light.grid.x)) - 1.0, corner.z, 1.0);
  hand_over(v);
  g_box = f.box;
#ifdef PULL
  g_id = uvec2(v_instance[0] + 1u, v_triangle[0]);
#else
  g_id = uvec2(v_instance[0] + 1u, uint(gl_PrimitiveIDIn));
#endif
#ifdef LAYERS
  gl_Layer = layer;
#endif
  EmitVertex();
}

void spawn(Vertices v, int layer) {
  Footprint f = make_footprint(face_of_layer(light, layer), windows[layer], v.a, v.b, v.c, dilation);
  if (f.count == 0) return;
#ifdef REST
  if (f.square <= hardware_square) return;
#endif
#ifdef PYRAMID
  if (behind_all(f, layer)) return;
#endif
#ifdef COUNT
  atomicAdd(counters.triangles, 1u);
#ifdef PULL
  atomicAdd(counters.drawn, 1u);
#endif
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
#ifdef PULL
  spawn(v, int(v_layer[0]));
#elif defined(LAYERS)
  for (int layer = layers.x; layer < layers.y; ++layer)
    if (windows[layer].guard.y != 0.0) spawn(v, layer);  // a face that no receiver is seen through costs nothing
#else
  spawn(v, 0);
#endif
}

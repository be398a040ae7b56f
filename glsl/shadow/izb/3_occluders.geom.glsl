#version 450 core
// Before 5.3, and not the paper's: depths from which on whole texels of the light-space grid are surely in shadow (Tokuyoshi and
// Mizokuchi 2018). LAYERS: into those of [first, end) in `layers`, at most LAYERS of them.
layout(triangles) in;
#include "shared/bindings.h"
#include "shared/occluder.h"

#ifdef LAYERS
layout(triangle_strip, max_vertices = 3 * LAYERS) out;
layout(location = 2) uniform ivec2 layers;
#else
layout(triangle_strip, max_vertices = 3) out;
#endif

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };

layout(location = 0) in vec3 v_position_vs[];

void emit(vec3 corner, int layer) {
  gl_Position = vec4(corner.xy * (2.0 / float(light.grid.x)) - 1.0, corner.z, 1.0);
#ifdef LAYERS
  gl_Layer = layer;
#endif
  EmitVertex();
}

void spawn(int layer) {
  Occluder o = make_occluder(face_of_layer(light, layer), windows[layer], v_position_vs[0], v_position_vs[1], v_position_vs[2]);
  if (!o.any) return;
  emit(o.p0, layer);
  emit(o.p1, layer);
  emit(o.p2, layer);
  EndPrimitive();
}

void main() {
#ifdef LAYERS
  for (int layer = layers.x; layer < layers.y; ++layer) spawn(layer);
#else
  spawn(0);
#endif
}

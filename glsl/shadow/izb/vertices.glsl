// What a geometry shader gets of a triangle and hands to the test, after `layout(triangles) in`. MASKED: also where its
// vertices stand on the texture of its alpha mask. PULL: from a list, with the number of each and its layer.
#include "shared/bindings.h"
#include "shared/hits.h"
#include "shared/pairs.h"

layout(location = 0) in vec3 v_position_vs[];
layout(location = 1) flat in uint v_instance[];
#ifdef PULL
layout(location = 2) flat in uint v_triangle[];
layout(location = 3) flat in uint v_layer[];
#endif

layout(location = 0) flat out vec3 g_a;
layout(location = 1) flat out vec3 g_b;
layout(location = 2) flat out vec3 g_c;
layout(location = 4) flat out uvec2 g_id;

#ifdef MASKED
layout(location = 5) in vec2 v_uv[];

layout(location = 5) flat out vec2 g_uv_a;
layout(location = 6) flat out vec2 g_uv_b;
layout(location = 7) flat out vec2 g_uv_c;
#endif

// The triangle as the test takes it.
struct Vertices {
  vec3 a;
  vec3 b;
  vec3 c;
#ifdef MASKED
  vec2 uv_a;
  vec2 uv_b;
  vec2 uv_c;
#endif
};

// Several samples take them in the order of their positions, found once a triangle.
Vertices make_vertices() {
  Vertices v;
  v.a = v_position_vs[0];
  v.b = v_position_vs[1];
  v.c = v_position_vs[2];
#ifdef MASKED
  v.uv_a = v_uv[0];
  v.uv_b = v_uv[1];
  v.uv_c = v_uv[2];
#ifdef SPP32
  order_with_uvs(v.a, v.b, v.c, v.uv_a, v.uv_b, v.uv_c);
#endif
#elif defined(SPP32)
  order_vertices(v.a, v.b, v.c);
#endif
  return v;
}

void hand_over(Vertices v) {
  g_a = v.a;
  g_b = v.b;
  g_c = v.c;
#ifdef MASKED
  g_uv_a = v.uv_a;
  g_uv_b = v.uv_b;
  g_uv_c = v.uv_c;
#endif
}

#ifdef COUNT
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
#endif

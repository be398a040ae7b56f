// What a geometry shader gets of a triangle and hands to the test, after `layout(triangles) in`.
#include "shared/bindings.h"
#include "shared/pairs.h"

layout(location = 0) in vec3 v_position_vs[];
layout(location = 1) flat in uint v_instance[];

layout(location = 0) flat out vec3 g_a;
layout(location = 1) flat out vec3 g_b;
layout(location = 2) flat out vec3 g_c;
layout(location = 4) flat out uvec2 g_id;

#ifdef COUNT
layout(std430, binding = BIND_COUNTERS) buffer CounterBlock { Counters counters; };
#endif

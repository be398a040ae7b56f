#version 450 core
// 5.5 A point that is drawn only if the list of unsure pairs overflowed: the condition of the pass in double.
#include "shared/bindings.h"
#include "shared/pairs.h"

layout(std430, binding = BIND_COUNTERS) readonly buffer CounterBlock { Counters counters; };

void main() {
  gl_Position = vec4(counters.pairs > counters.capacity ? 0.0 : 2.0, 0.0, 0.0, 1.0);
}

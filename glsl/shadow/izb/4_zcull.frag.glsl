#version 450 core
// 5.4 Depth of the furthest node, 0 where the list is empty, so that early z culls what lies behind and what tests nobody.
#include "shared/bindings.h"

layout(binding = UNIT_FURTHEST) uniform usampler2DArray furthest;

// 16 bits a texel, as hardware's own z-cull has few: rounded up, and one step more for the fragments' rounding.
void main() {
  float z = uintBitsToFloat(texelFetch(furthest, ivec3(gl_FragCoord.xy, gl_Layer), 0).x);
  gl_FragDepth = z > 0.0 ? (ceil(z * 65535.0) + 1.0) / 65535.0 : 0.0;
}

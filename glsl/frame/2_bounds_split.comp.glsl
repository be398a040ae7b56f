#version 450 core
// 6.4 Where the cascades end: a logarithmic split of the visible depth range.
#include "shared/bindings.h"
#include "shared/bounds.h"

layout(local_size_x = 1) in;

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_CASCADES) buffer CascadeBlock { CascadeRange range; };

void main() {
  CascadeRange cut = range;
  split_cascades(cut, int(light.grid.y));
  range = cut;
}

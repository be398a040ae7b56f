// A triangle's vertices by position: two triangles that share an edge then give the same numbers for it.
#include "shared/occlusion.h"

void order(inout vec3 first, inout vec3 second) {
  bool swapped = position_less(second, first);
  vec3 kept = first;
  first = swapped ? second : first;
  second = swapped ? kept : second;
}

void order_vertices(inout vec3 a, inout vec3 b, inout vec3 c) {
  order(a, b);
  order(b, c);
  order(a, b);
}

// 5.3 Which receivers the occlusion prepass (3_occluders.geom.glsl) has in surely full shadow: they get no node.
#include "shared/occluder.h"

layout(binding = UNIT_OCCLUDERS) uniform sampler2DArray occluders;

const int most_hidden_texels = 5;  // along one side; larger ones are tested

// Is all between `low` and `high`, in texels of the grid, with no point nearer than `nearest`, behind occluders?
bool behind_occluders(LightWindow window, int layer, vec2 low, vec2 high, float nearest) {
#ifdef COUNT_NODES
  // Another program than the one that inserts, which may round in another way: never fewer nodes are counted.
  low -= 0.001;
  high += 0.001;
  nearest -= 1.0 / 65535.0;
#endif
  // So that a NaN hides nothing.
  if (!(all(greaterThanEqual(low, vec2(0.0))) && all(lessThan(high, vec2(window.guard.y))))) return false;
  ivec2 first = ivec2(floor(low));
  ivec2 size = ivec2(floor(high)) - first + 1;
  if (any(greaterThan(size, ivec2(most_hidden_texels)))) return false;
  ivec2 at = ivec2(0);
  bool hidden = true;
  while (hidden && at.y < size.y) {
    hidden = texelFetch(occluders, ivec3(first + at, layer), 0).x < nearest;
    ++at.x;
    if (at.x == size.x) at = ivec2(0, at.y + 1);
  }
  return hidden;
}

// So near to a positional light, or behind it, a margin in depth is none in distance (hidden_margin).
bool is_near_light(LightFrame face, float z, float bias) { return is_positional(face) && !(z > 64.0 * bias); }

#ifdef SPP32
bool is_hidden(CameraFrame camera, LightFrame face, LightWindow window, int layer, MicroQuad quad, QuadPart part) {
  if (!part.whole) return false;
  vec3 low = grid_position(window, part.low);
  vec3 high = grid_position(window, part.high);
  float guard = quad_guard(window, part) + 0.001;
  float center_z = light_position(face, quad.center).z;
  float z = least_depth(quad, vec3(0.0, 0.0, center_z));
  float bias = largest_bias(camera, quad.center, quad.t, quad.doubt.x);
  bool drawn_in = is_positional(face) && z < 0.06 * center_z;  // corners may be: micro_quad_uvd
  if (drawn_in || is_near_light(face, z, bias)) return false;
  float nearest = low.z - depth_guard(window, part.slack.y) - hidden_margin(face, window, bias, z);
  return behind_occluders(window, layer, low.xy - guard, high.xy + guard, nearest);
}
#else
bool is_hidden(CameraFrame camera, LightFrame face, LightWindow window, int layer, vec3 p, float t) {
  vec3 p_ls = light_position(face, p);
  vec3 grid = grid_position(window, light_uvd(face, p_ls));
  float bias = largest_bias(camera, p, t, 0.0);
  if (is_near_light(face, p_ls.z, bias)) return false;
  float nearest = grid.z - window.depth.z - hidden_margin(face, window, bias, p_ls.z);
  return behind_occluders(window, layer, grid.xy - window.guard.x, grid.xy + window.guard.x, nearest);
}
#endif

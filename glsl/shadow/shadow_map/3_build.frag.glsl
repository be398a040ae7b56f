#version 450 core
// The depth map's texel. MASKED: through an alpha mask's holes light falls; the mask is asked where the light's ray through
// the texel's centre meets the triangle.
#ifdef MASKED
#include "shared/bindings.h"
#include "shared/alpha.glsl"
#include "shared/depth_map.h"
#include "shared/geometry.glsl"
#include "shared/uvs.glsl"

layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
layout(location = 0) uniform int layer;
layout(location = 1) uniform float margin;  // texels

layout(location = 0) flat in uint v_instance;

void main() {
  uint triangle = uint(gl_PrimitiveID);
  vec3 corners[3] = triangle_vs(v_instance, triangle);
  vec2 uv[3] = triangle_uvs(v_instance, triangle);
  LightFrame face = light_face(light, layer / int(light.grid.y));
  LightWindow window = with_margin(windows[layer], margin);
  Cutout cutout = make_cutout(instances[v_instance].info.y, uv[0], uv[1], uv[2]);
  dvec3 weights = fragment_weights(face, window, gl_FragCoord.xy, corners[0], corners[1], corners[2]);
  if (!is_there(cutout.map, texel_of_weights(cutout.corners, weights))) discard;
}
#else
layout(early_fragment_tests) in;

void main() {}
#endif

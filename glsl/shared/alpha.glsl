// Alpha masks as shaders read them: is the material there? And where a triangle's corners stand on its map.
#include "shared/alpha.h"
#include "shared/hits.h"

layout(std430, binding = BIND_MATERIALS) readonly buffer MaterialBlock { MaterialFrame materials[]; };
layout(binding = UNIT_ALPHA) uniform usamplerBuffer alpha_maps;

// What the test of a masked triangle takes.
struct Cutout {
  AlphaMap map;
  TexelCorners corners;
};

Cutout make_cutout(uint material, vec2 uv_a, vec2 uv_b, vec2 uv_c) {
  MaterialFrame m = materials[material];
  return Cutout(alpha_map(m), TexelCorners(texel_position(m, uv_a), texel_position(m, uv_b), texel_position(m, uv_c)));
}

bool is_there(AlphaMap map, dvec2 texel) {
  AlphaTexels t = alpha_texels(map, texel);
  vec4 texels = vec4(texelFetch(alpha_maps, t.index.x).x, texelFetch(alpha_maps, t.index.y).x,
                     texelFetch(alpha_maps, t.index.z).x, texelFetch(alpha_maps, t.index.w).x);
  return passes_cutoff(map, texels, t.between);
}

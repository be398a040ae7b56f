// What an alpha mask leaves of a triangle's shadow (the 2016 extension of the paper), where ALPHA_EXACT or ALPHA_FRAGMENT asks
// for it: at each sample's own hit, or once a fragment of the light-space grid.
#include "shared/alpha.glsl"

#ifdef ALPHA_EXACT
#ifdef SPP32
// One of the bits that are left in `open`, if there is one.
#define CUT_ONE                                                                                         \
  {                                                                                                     \
    uint bit = open & (~open + 1u);                                                                     \
    open ^= bit;                                                                                        \
    vec2 offset = samples.offset_px[max(findLSB(bit), 0)].xy;                                           \
    if (is_there(cutout.map, texel_of_sample(hits, offset))) kept |= bit;                               \
  }

// Those of the bits whose samples hit what is there. `open`: bits that a driver's limit of loops has left undecided. Four a
// round, since that limit counts the rounds of all loops together.
uint uncut_bits(Cutout cutout, QuadPlanes planes, uint bits, out uint open) {
  HitPlanes hits = hit_planes(planes, cutout.corners);
  uint kept = 0u;
  open = bits;
  while (open != 0u) {
    CUT_ONE CUT_ONE CUT_ONE CUT_ONE
  }
  return kept;
}
#else
bool is_uncut(Cutout cutout, LightFrame light, vec3 p, vec3 a, vec3 b, vec3 c) {
  return is_there(cutout.map, texel_of_weights(cutout.corners, light_weights(light, p, a, b, c)));
}
#endif
#endif

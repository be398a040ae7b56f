#version 450 core
// 5.3 Creating the irregular z-buffer: each receiver goes into the list of its light-space texel. Nodes stand in a
// preallocated screen-space grid, so that a node's address is its pixel and a node needs nothing but a next pointer (6.2);
// the receiver's eye distance stands beside it, since a walk that reads one reads the other.
#include "shared/bindings.h"
#include "shared/bounds.h"
#include "shared/lists.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std430, binding = BIND_WINDOW) readonly buffer WindowBlock { LightWindow window; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = IMAGE_HEADS, r32ui) uniform uimage2D heads;
layout(binding = IMAGE_NODES, rg32ui) writeonly uniform uimage2D nodes;
layout(binding = IMAGE_FURTHEST, r32ui) uniform uimage2D furthest;

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  if (px.x >= int(camera.size_px.x) || px.y >= int(camera.size_px.y)) return;
  float t = texelFetch(eye_distance_texture, px, 0).x;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
  vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
  uint pixel_class = t > 0.0 ? receiver_class(light, p, normal) : class_sky;
  if (pixel_class != class_receiver) {
    imageStore(nodes, px, uvec4(not_a_node(pixel_class)));
    return;
  }

  vec3 grid = grid_position(window, light_uvd(light, light_position(light, p)));
  ivec2 texel = grid_texel(light, grid);
  uint next = imageAtomicExchange(heads, texel, node_from_pixel(px));
  imageStore(nodes, px, uvec4(next, floatBitsToUint(t), 0u, 0u));
#ifdef ZCULL
  imageAtomicMax(furthest, texel, floatBitsToUint(grid.z + window.depth.z));
#endif
}

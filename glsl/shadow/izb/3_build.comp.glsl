#version 450 core
// 5.3 Creating the irregular z-buffer: each receiver goes into the list of its light-space texel. Nodes stand in a
// preallocated screen-space grid, so that a node's address is its pixel and slot and a node needs nothing but a next pointer
// (6.2); at one sample a pixel the receiver's eye distance stands beside it, since a walk that reads one reads the other.
// Defines: ZCULL; SPP32, and then how it is inserted (6.1): COVER (texels that answer for all of it), BY_VIEW,
// BY_SAMPLES, or POOL (every texel that it touches; COUNT_NODES only counts them); STRIDE: in another order, for tests.
#include "shared/bindings.h"
#include "shared/insertion.h"
#include "shadow/izb/nodes.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_cascades]; };
layout(std140, binding = BIND_CASCADE_ENDS) uniform CascadeBlock { CascadeRange range; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = IMAGE_HEADS, r32ui) uniform uimage2DArray heads;
layout(binding = IMAGE_FURTHEST, r32ui) uniform uimage2DArray furthest;
layout(binding = IMAGE_NODES, NODE_FORMAT) writeonly uniform NODE_IMAGE nodes;
#ifdef SPP32
layout(std140, binding = BIND_SAMPLES) uniform SampleBlock { SampleFrame samples; };
layout(binding = UNIT_MICRO_QUAD) uniform sampler2D micro_quad_texture;
#ifdef POOL
layout(location = 0) uniform ivec2 part;
#else
layout(location = 0) uniform int most_nodes;
#endif
#ifdef COVER
layout(location = 1) uniform float dilation;  // texels
#endif
#endif
#ifdef POOL
layout(std430, binding = BIND_POOL) buffer PoolBlock { PoolCounters pool; };
#endif

void raise_furthest(ivec3 texel, float depth) {
#ifdef ZCULL
  imageAtomicMax(furthest, texel, floatBitsToUint(depth));
#endif
}

uint push(ivec3 texel, uint node, float depth) {
  raise_furthest(texel, depth);
  return imageAtomicExchange(heads, texel, node);
}

#ifdef SPP32
#ifdef POOL
// The micro-quad's texels from part.x on, but for those from part.y on.
void insert_quad(ivec2 px, int cascade, LightWindow window, MicroQuad quad) {
  QuadOnGrid on_grid = project_quad(light, window, quad);
  const int all = 0x7fff;
  Cover cover = make_cover(on_grid, 0.5, window.guard.x + 0.001, int(light.grid.x) - 1, all);
  int count = 0;
  for (int i = 0; i < cover.rows.count; ++i)
    count += cover_row(cover, run_texel(cover.rows, i, cover.last), all).count;
#ifdef COUNT_NODES
  uint before = atomicAdd(pool.nodes, uint(count));
  if (before + uint(count) < before) atomicAdd(pool.carries, 1u);
  atomicMax(pool.largest_quad, uint(count));
#else
  int end = min(count, part.y);
  if (end <= part.x) return;
  uint node = atomicAdd(pool.nodes, uint(end - part.x)) + 1u;
  // One loop, so that its rounds are at most its own rows and texels, whatever the other lanes' rows are like.
  int i = 0, first = 0, k = 0;  // of the row: number, texels before it, next texel
  while (i < cover.rows.count && first + k < end) {
    int row = run_texel(cover.rows, i, cover.last);
    Run columns = cover_row(cover, row, all);
    k = max(k, part.x - first);
    if (k < columns.count) {
      uint next = push(ivec3(cover_texel(cover, row, columns, k), cascade), node, on_grid.deepest);
      imageStore(nodes, NODE_TEXEL(node), node_words(next, px, 0.0));
      ++node;
      ++k;
    }
    if (k >= columns.count) {
      first += columns.count;
      ++i;
      k = 0;
    }
  }
#endif
}
#else
void add_node(ivec2 px, int cascade, ivec2 texel, float depth, inout int slot) {
  uint next = push(ivec3(texel, cascade), node_from_pixel(px, slot), depth);
  imageStore(nodes, ivec3(px, slot), uvec4(next));
  ++slot;
}

ivec2 texel_of(LightWindow window, MicroQuad quad, vec2 offset_px) {
  return grid_texel(light, grid_position(window, micro_quad_uvd(light, quad, offset_px)));
}

#ifdef BY_SAMPLES
void insert_samples(ivec2 px, int cascade, LightWindow window, MicroQuad quad, float depth, inout int slot) {
  for (int i = 0; i < 32 && slot < most_nodes; ++i) {
    ivec2 texel = texel_of(window, quad, samples.offset_px[i].xy);
    bool known = false;
    for (int k = 0; k < i; ++k) known = known || texel == texel_of(window, quad, samples.offset_px[k].xy);
    if (!known) add_node(px, cascade, texel, depth, slot);
  }
}
#else
// Half the micro-quad along the view ray, as a sample offset.
vec2 view_axis(MicroQuad quad) {
  float steepest = max(abs(quad.tilt.x), abs(quad.tilt.y));
  return steepest > 0.0 ? quad.tilt * (0.5 / steepest) : vec2(0.5, 0.0);
}

// The paper's: a row of nodes along the view ray.
void insert_row(ivec2 px, int cascade, LightWindow window, MicroQuad quad, float depth, int count, inout int slot) {
  vec2 axis = view_axis(quad);
  ivec2 last = ivec2(-1);
  for (int i = 0; i < count; ++i) {
    ivec2 texel = texel_of(window, quad, axis * ((2.0 * float(i) + 1.0) / float(count) - 1.0));
    if (texel != last) add_node(px, cascade, texel, depth, slot);
    last = texel;
  }
}
#endif

#ifdef BY_VIEW
int nodes_by_view(ivec2 px, MicroQuad quad) {
  // The footprint is 1 / N.V times as long as wide.
  vec3 normal = normalize(octahedral_direction(texelFetch(normal_texture, px, 0).xy));
  vec3 view = is_perspective(camera) ? normalize(quad.center) : vec3(0.0, 0.0, -1.0);
  return clamp(int(ceil(1.0 / max(abs(dot(normal, view)), 0.0001))), 1, most_nodes);
}
#endif

#ifdef COVER
void insert_cover(ivec2 px, int cascade, LightWindow window, MicroQuad quad, QuadOnGrid on_grid, inout int slot) {
  Cover cover = make_cover(on_grid, dilation, window.guard.x + 0.001, int(light.grid.x) - 1, most_nodes);
  // Too long for it: the paper's row samples better, where it runs along the long axis.
  vec2 axis = view_axis(quad);
  vec2 ends = abs(grid_position(window, micro_quad_uvd(light, quad, axis)).xy -
                  grid_position(window, micro_quad_uvd(light, quad, -axis)).xy);
  if (cover.rows.count < cover.rows.needed && max(ends.x, ends.y) > 0.5 * cover.long_side) {
    insert_row(px, cascade, window, quad, on_grid.deepest, most_nodes, slot);
    return;
  }
  for (int i = 0; i < cover.rows.count; ++i) {
    int row = run_texel(cover.rows, i, cover.last);
    Run columns = cover_row(cover, row, most_nodes - slot - (cover.rows.count - 1 - i));  // one for each row to come
    for (int k = 0; k < columns.count; ++k)
      add_node(px, cascade, cover_texel(cover, row, columns, k), on_grid.deepest, slot);
  }
}
#endif

void insert_quad(ivec2 px, int cascade, LightWindow window, MicroQuad quad) {
  QuadOnGrid on_grid = project_quad(light, window, quad);
  int slot = 0;
#if defined(BY_SAMPLES)
  insert_samples(px, cascade, window, quad, on_grid.deepest, slot);
#elif defined(BY_VIEW)
  insert_row(px, cascade, window, quad, on_grid.deepest, nodes_by_view(px, quad), slot);
#else
  insert_cover(px, cascade, window, quad, on_grid, slot);
#endif
}
#endif
#endif

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  if (px.x >= int(camera.size_px.x) || px.y >= int(camera.size_px.y)) return;
#ifdef STRIDE
  uint n = (uint(px.y) * camera.size_px.x + uint(px.x)) * STRIDE % (camera.size_px.x * camera.size_px.y);
  px = ivec2(n % camera.size_px.x, n / camera.size_px.x);
#endif
  float t = texelFetch(eye_distance_texture, px, 0).x;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t);
  vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
  if (!(t > 0.0) || receiver_class(light, p, normal) != class_receiver) return;

  int cascade = cascade_of(range, int(light.grid.y), t);
  LightWindow window = windows[cascade];
#ifdef SPP32
  insert_quad(px, cascade, window, make_micro_quad(camera, px, texelFetch(micro_quad_texture, px, 0)));
#else
  vec3 grid = grid_position(window, light_uvd(light, light_position(light, p)));
  uint next = push(ivec3(grid_texel(light, grid), cascade), node_from_pixel(px, 0), grid.z + window.depth.z);
  imageStore(nodes, px, node_words(next, px, t));
#endif
}

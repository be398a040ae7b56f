#version 450 core
// 5.3 Creating the irregular z-buffer: each receiver goes into the list of its light-space texel. Nodes stand in a
// preallocated screen-space grid, so that a node's address is its pixel and slot and a node needs nothing but a next pointer
// (6.2); at one sample a pixel the receiver's eye distance stands beside it, since a walk that reads one reads the other.
// Defines: OCCLUDERS: but for receivers in surely full shadow (hidden.glsl); ZCULL; CUBE: a grid for each of six faces; SPP32, and then how it is inserted (6.1): COVER (texels that answer for
// all of it), BY_VIEW, BY_SAMPLES, or POOL (every texel that it touches; COUNT_NODES only counts them); STRIDE: in another
// order, for tests.
#include "shared/bindings.h"
#include "shared/faces.h"
#include "shadow/izb/nodes.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_WINDOWS) uniform WindowBlock { LightWindow windows[max_layers]; };
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
#ifdef CUBE
layout(location = 2) uniform int only_face;  // so that the largest grids' rows stay below a software renderer's rounds
#endif
#else
layout(location = 0) uniform int most_nodes;
#endif
#ifdef COVER
layout(location = 1) uniform float dilation;  // texels
#endif
#endif
#ifdef OCCLUDERS
layout(binding = IMAGE_MASK, r32ui) writeonly uniform uimage2D mask;
#include "shadow/izb/hidden.glsl"
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
// A pixel's nodes go to one slot after the other, whatever grid they are in.
struct Slots {
  ivec2 px;
  int used;
};

#ifdef POOL
// Texels from part.x on, but for those from part.y on.
void insert_part(int layer, LightFrame face, LightWindow window, MicroQuad quad, QuadPart part_of_quad, Slots slots) {
  QuadOnGrid on_grid = part_on_grid(face, window, quad, part_of_quad);
  const int all = 0x7fff;
  Cover cover = make_cover(on_grid, 0.5, quad_guard(window, part_of_quad) + 0.001, last_texel(window), all);
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
      uint next = push(ivec3(cover_texel(cover, row, columns, k), layer), node, on_grid.deepest);
      imageStore(nodes, NODE_TEXEL(node), node_words(next, slots.px, 0.0));
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
// Where points of the micro-quad go.
struct Place {
  LightFrame face;
  LightWindow window;
  int layer;
  float depth;  // of the deepest point
  float guard;  // texels by which they may be off
  bool whole;   // all of the micro-quad goes there
};

void add_node(Place at, ivec2 texel, inout Slots slots) {
  uint next = push(ivec3(texel, at.layer), node_from_pixel(slots.px, slots.used), at.depth);
  imageStore(nodes, ivec3(slots.px, slots.used), uvec4(next));
  ++slots.used;
}

ivec2 texel_of(Place at, MicroQuad quad, vec2 offset_px) {
  return grid_texel(at.window, grid_position(at.window, micro_quad_uvd(at.face, quad, offset_px)));
}

// Is the point seen through that face?
bool is_there(Place at, MicroQuad quad, vec2 offset_px) {
  return at.whole || face_of(light_position(at.face, micro_quad_point(quad, offset_px))) == 0;
}

#ifdef BY_SAMPLES
void insert_samples(Place at, MicroQuad quad, inout Slots slots) {
  for (int i = 0; i < 32 && slots.used < most_nodes; ++i) {
    vec2 offset = samples.offset_px[i].xy;
    ivec2 texel = texel_of(at, quad, offset);
    bool known = !is_there(at, quad, offset);
    for (int k = 0; k < i; ++k)
      known = known || (texel == texel_of(at, quad, samples.offset_px[k].xy) && is_there(at, quad, samples.offset_px[k].xy));
    if (!known) add_node(at, texel, slots);
  }
}
#else
// Half the micro-quad along the view ray, as a sample offset.
vec2 view_axis(MicroQuad quad) {
  float steepest = max(abs(quad.tilt.x), abs(quad.tilt.y));
  return steepest > 0.0 ? quad.tilt * (0.5 / steepest) : vec2(0.5, 0.0);
}

// The paper's: a row of nodes along the view ray.
void insert_row(Place at, MicroQuad quad, int count, inout Slots slots) {
  vec2 axis = view_axis(quad);
  ivec2 last = ivec2(-1);
  for (int i = 0; i < count && slots.used < most_nodes; ++i) {
    vec2 offset = axis * ((2.0 * float(i) + 1.0) / float(count) - 1.0);
    if (!is_there(at, quad, offset)) continue;
    ivec2 texel = texel_of(at, quad, offset);
    if (texel != last) add_node(at, texel, slots);
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
void insert_cover(Place at, MicroQuad quad, QuadOnGrid on_grid, inout Slots slots) {
  int room = most_nodes - slots.used;
  Cover cover = make_cover(on_grid, dilation, at.guard + 0.001, last_texel(at.window), room);
  // Too long for it: the paper's row samples better, where it runs along the long axis.
  vec2 axis = view_axis(quad);
  vec2 ends = abs(grid_position(at.window, micro_quad_uvd(at.face, quad, axis)).xy -
                  grid_position(at.window, micro_quad_uvd(at.face, quad, -axis)).xy);
  if (at.whole && cover.rows.count < cover.rows.needed && max(ends.x, ends.y) > 0.5 * cover.long_side) {
    insert_row(at, quad, room, slots);
    return;
  }
  for (int i = 0; i < cover.rows.count; ++i) {
    int row = run_texel(cover.rows, i, cover.last);
    Run columns = cover_row(cover, row, most_nodes - slots.used - (cover.rows.count - 1 - i));  // one for each row to come
    for (int k = 0; k < columns.count; ++k) add_node(at, cover_texel(cover, row, columns, k), slots);
  }
}
#endif

void insert_part(int layer, LightFrame face, LightWindow window, MicroQuad quad, QuadPart part, inout Slots slots) {
  QuadOnGrid on_grid = part_on_grid(face, window, quad, part);
  Place at = Place(face, window, layer, on_grid.deepest, quad_guard(window, part), part.whole);
#if defined(BY_SAMPLES)
  insert_samples(at, quad, slots);
#elif defined(BY_VIEW)
  insert_row(at, quad, nodes_by_view(slots.px, quad), slots);
#else
  if (slots.used < most_nodes) insert_cover(at, quad, on_grid, slots);
#endif
}
#endif

// In surely full shadow? Then its mask is all that there is to do.
bool is_done(ivec2 px, LightFrame face, int layer, MicroQuad quad, QuadPart part) {
#ifdef OCCLUDERS
  if (is_hidden(camera, face, windows[layer], layer, quad, part)) {
#ifndef COUNT_NODES
    imageStore(mask, px, uvec4(0xffffffffu));
#endif
    return true;
  }
#endif
  return false;
}

void insert_quad(ivec2 px, int cascade, MicroQuad quad) {
  Slots slots = Slots(px, 0);
#if defined(CUBE) && defined(POOL)
  QuadPart part_of_quad = quad_part(light, quad, only_face);
  int layer = only_face * int(light.grid.y) + cascade;
  LightFrame face = light_face(light, only_face);
  if (!part_of_quad.any || is_done(px, face, layer, quad, part_of_quad)) return;
  insert_part(layer, face, windows[layer], quad, part_of_quad, slots);
#elif defined(CUBE)
  int f = face_of(light_position(light, quad.center));
  for (int i = 0; i < cube_faces; ++i) {
    QuadPart part_of_quad = quad_part(light, quad, f);
    int layer = f * int(light.grid.y) + cascade;
    LightFrame face = light_face(light, f);
    if (part_of_quad.any && is_done(px, face, layer, quad, part_of_quad)) break;
    if (part_of_quad.any) insert_part(layer, face, windows[layer], quad, part_of_quad, slots);
    if (part_of_quad.whole) break;
    f = f == cube_faces - 1 ? 0 : f + 1;
  }
#else
  QuadPart whole = whole_quad(light, quad);
  if (!is_done(px, light, cascade, quad, whole)) insert_part(cascade, light, windows[cascade], quad, whole, slots);
#endif
}
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
#ifdef SPP32
  insert_quad(px, cascade, make_micro_quad(camera, px, texelFetch(micro_quad_texture, px, 0)));
#else
  int f = 0;
#ifdef CUBE
  f = face_of(light_position(light, p));
#endif
  LightFrame face = light_face(light, f);
  int layer = f * int(light.grid.y) + cascade;
  LightWindow window = windows[layer];
#ifdef OCCLUDERS
  if (is_hidden(camera, face, window, layer, p, t)) {
    imageStore(mask, px, uvec4(0xffffffffu));
    return;
  }
#endif
  vec3 grid = grid_position(window, light_uvd(face, light_position(face, p)));
  uint next = push(ivec3(grid_texel(window, grid), layer), node_from_pixel(px, 0), grid.z + window.depth.z);
  imageStore(nodes, px, node_words(next, px, t));
#endif
}

// SPDX-License-Identifier: MIT
// The camera of the frame, and the point that a pixel sees. View space: camera at the origin, looking along -z.
#ifndef IZB_SHARED_CAMERA_H
#define IZB_SHARED_CAMERA_H
#include "shared/lang.h"
SHARED_BEGIN

struct CameraFrame {
  mat4 clip_from_view;  // reversed depth in [0, 1]: 1 at the near plane
  vec4 pixel_ray;       // q = px * xy + zw; px counts from the bottom left corner, pixel centres at .5, where rays
                        // pass whose camera has no shift within the pixel
  vec4 footprint;       // x, y: a pixel's width in world units at eye distance t is x * t + y
                        // z: 1 perspective, 0 orthographic
  uvec4 size_px;        // width, height
};

// An instance's rigid (or affine) placement, as rows of view_from_object, and where its triangles stand.
struct InstanceFrame {
  vec4 row_x;
  vec4 row_y;
  vec4 row_z;
  uvec4 info;  // x: first triangle in the frame's numbering, y: material, z: first entry in the index buffer,
               // w: vertex that its index 0 means
};

SHARED vec3 placed(IN(vec4) row_x, IN(vec4) row_y, IN(vec4) row_z, IN(vec3) p) {
  PRECISE float x = ((row_x.x * p.x + row_x.y * p.y) + row_x.z * p.z) + row_x.w;
  PRECISE float y = ((row_y.x * p.x + row_y.y * p.y) + row_y.z * p.z) + row_y.w;
  PRECISE float z = ((row_z.x * p.x + row_z.y * p.y) + row_z.z * p.z) + row_z.w;
  return vec3(x, y, z);
}

// The one way in which a vertex reaches view space, in every stage and in C++: the scene of the frame *is* these floats.
SHARED vec3 view_from_object(IN(InstanceFrame) instance, IN(vec3) p) {
  return placed(instance.row_x, instance.row_y, instance.row_z, p);
}

SHARED bool is_perspective(IN(CameraFrame) camera) { return camera.footprint.z != 0.0f; }

// The point at eye distance t > 0 (along -z) on the ray of pixel position px. Perspective: (q t, -t); orthographic:
// (q, -t).
SHARED vec3 receiver_point(IN(CameraFrame) camera, IN(vec2) px, float t) {
  PRECISE float qx = px.x * camera.pixel_ray.x + camera.pixel_ray.z;
  PRECISE float qy = px.y * camera.pixel_ray.y + camera.pixel_ray.w;
  PRECISE float s = is_perspective(camera) ? t : 1.0f;
  PRECISE float x = qx * s;
  PRECISE float y = qy * s;
  return vec3(x, y, -t);
}

// A pixel's width in world units at eye distance t: the unit in which errors are judged.
SHARED float pixel_width(IN(CameraFrame) camera, float t) {
  PRECISE float width = camera.footprint.x * t + camera.footprint.y;
  return width;
}

// Unit vectors in two floats (Cigolle et al. 2014, octahedral).
SHARED vec2 octahedral_encode(IN(vec3) n) {
  PRECISE float s = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
  float u = n.x * s;
  float v = n.y * s;
  float wrapped_u = (1.0f - abs(v)) * (u >= 0.0f ? 1.0f : -1.0f);
  float wrapped_v = (1.0f - abs(u)) * (v >= 0.0f ? 1.0f : -1.0f);
  return n.z >= 0.0f ? vec2(u, v) : vec2(wrapped_u, wrapped_v);
}

// In place of a normal: the pixel's triangle is seen edge-on, so that it has no side.
SHARED vec2 octahedral_none() { return vec2(2.0f, 2.0f); }

// Along the encoded vector, not unit length: sums only, so that C++ and every GPU get the same bits. 0 for none.
SHARED vec3 octahedral_direction(IN(vec2) e) {
  if (e.x > 1.5f) return vec3(0.0f);
  PRECISE float z = (1.0f - abs(e.x)) - abs(e.y);
  PRECISE float folded_x = 1.0f - abs(e.y);
  PRECISE float folded_y = 1.0f - abs(e.x);
  float x = z >= 0.0f ? e.x : (e.x >= 0.0f ? folded_x : -folded_x);
  float y = z >= 0.0f ? e.y : (e.y >= 0.0f ? folded_y : -folded_y);
  return vec3(x, y, z);
}

SHARED vec3 octahedral_decode(IN(vec2) e) { return normalize(octahedral_direction(e)); }

SHARED_END
#endif

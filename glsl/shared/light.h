// SPDX-License-Identifier: MIT
// The light of the frame, its window over the visible pixels (5.2), and the mapping of points to the light-space grid.
#ifndef IZB_SHARED_LIGHT_H
#define IZB_SHARED_LIGHT_H
#include "shared/camera.h"
SHARED_BEGIN

// What the CPU knows of the light. Light space: x, y across, z along the light's way (depth grows away from the light).
struct LightFrame {
  vec4 axis_x;    // rows of light_from_view, unit length; w: see holds_light
  vec4 axis_y;    // w: texels that a grid uses for each receiver, 0: all of them
  vec4 axis_z;
  vec4 origin;    // xyz: position of a spot or point light, 0 for a directional one; w: 1 positional, 0 directional
  vec4 to_light;  // directional: unit vector towards the light; w: cosine of the spot's half-angle, -1: no cone
  vec4 color;     // linear; w: 1 if pixels with N.L <= 0 stay out of the IZB (6.5)
  uvec4 grid;     // x: texels along one side of the light-space grid, y: cascades, z: faces, 1 or cube_faces
};

const int max_cascades = 8;
const int cube_faces = 6;
const int max_layers = 48;  // of the grid: for each face its cascades

// What the bounds stage finds: the tight window over the receivers, one a layer.
struct LightWindow {
  vec4 window;  // grid position = (uv - xy) * zw
  vec4 depth;   // depth = x + y * d, in [1/4, 3/4] over the receivers; z: guard for its rounding error
  vec4 guard;   // x: texels by which a receiver's grid position may be wrong; y: texels in use along one side, 0: no receiver
};

const float unit_roundoff = 5.9604644775390625e-8f;  // u = 2^-24

SHARED float norm1(IN(vec3) v) {
  PRECISE float sum = (abs(v.x) + abs(v.y)) + abs(v.z);
  return sum;
}

// DIRECTIONAL: a program for directional lights only. Where all lanes run all code, that spares the other's.
SHARED bool is_positional(IN(LightFrame) light) {
#ifdef DIRECTIONAL
  return false;
#else
  return light.origin.w != 0.0f;
#endif
}

// Light-space position relative to the light's origin.
SHARED vec3 light_position(IN(LightFrame) light, IN(vec3) p_vs) {
  vec3 p = p_vs - vec3(light.origin);
  return vec3(dot(vec3(light.axis_x), p), dot(vec3(light.axis_y), p), dot(vec3(light.axis_z), p));
}

// ---- the cube around a light whose receivers lie all around it --------------------------------------------------------

// Light space turned so that face f looks along z. Coordinates are exchanged and change sign, so every face has the very same
// floats.
SHARED vec3 on_face(IN(vec3) p_ls, int f) {
  if (f == 1) return vec3(-p_ls.x, p_ls.y, -p_ls.z);
  if (f == 2) return vec3(-p_ls.z, p_ls.y, p_ls.x);
  if (f == 3) return vec3(p_ls.z, p_ls.y, -p_ls.x);
  if (f == 4) return vec3(p_ls.x, -p_ls.z, p_ls.y);
  if (f == 5) return vec3(p_ls.x, p_ls.z, -p_ls.y);
  return p_ls;
}

// The light with the axes of that face: as a point's coordinates change, so do the rows of the matrix that gives them.
SHARED LightFrame light_face(IN(LightFrame) light, int f) {
  vec3 x = on_face(vec3(light.axis_x.x, light.axis_y.x, light.axis_z.x), f);
  vec3 y = on_face(vec3(light.axis_x.y, light.axis_y.y, light.axis_z.y), f);
  vec3 z = on_face(vec3(light.axis_x.z, light.axis_y.z, light.axis_z.z), f);
  LightFrame face = light;
  face.axis_x = vec4(x.x, y.x, z.x, light.axis_x.w);
  face.axis_y = vec4(x.y, y.y, z.y, light.axis_y.w);
  face.axis_z = vec4(x.z, y.z, z.z, light.axis_z.w);
  return face;
}

// The light with the axes of the face that a layer of the grid is of.
SHARED LightFrame face_of_layer(IN(LightFrame) light, int layer) {
#if defined(CUBE) || defined(__cplusplus)
  return light_face(light, layer / int(light.grid.y));
#else
  return light;
#endif
}

// The face through which the light sees the point.
SHARED int face_of(IN(vec3) p_ls) {
  vec3 size = abs(p_ls);
  if (size.z >= size.x && size.z >= size.y) return p_ls.z < 0.0f ? 1 : 0;
  if (size.x >= size.y) return p_ls.x < 0.0f ? 3 : 2;
  return p_ls.y < 0.0f ? 5 : 4;
}

// ---- the grid -----------------------------------------------------------------------------------------------------------

// (u, v, d): where a light-space point falls. d is affine over the grid and monotone in depth: the depth itself
// (directional) or -1/depth (spot; z > 0 only).
SHARED vec3 light_uvd(IN(LightFrame) light, IN(vec3) p_ls) {
  if (is_positional(light)) return vec3(p_ls.x / p_ls.z, p_ls.y / p_ls.z, -1.0f / p_ls.z);
  return p_ls;
}

// Grid position in texels, and depth.
SHARED vec3 grid_position(IN(LightWindow) w, IN(vec3) uvd) {
  return vec3((uvd.x - w.window.x) * w.window.z, (uvd.y - w.window.y) * w.window.w, w.depth.x + w.depth.y * uvd.z);
}

// How far light_uvd's (u, v) may be off, forward error. |p|_1 covers the rotation's three products and two sums
// (3u each, axes <= 1) and the axes' own rounding (u); the subtraction of the origin adds u more; the division doubles
// it. Constants are rounded up.
SHARED float uv_error(IN(LightFrame) light, IN(vec3) p_vs, IN(vec3) p_ls) {
  float moved = 8.0f * unit_roundoff * (norm1(p_vs) + norm1(vec3(light.origin)));
  if (!is_positional(light)) return moved;
  return 2.0f * moved / p_ls.z * (1.0f + max(abs(p_ls.x), abs(p_ls.y)) / p_ls.z);
}

// The same for d.
SHARED float d_error(IN(LightFrame) light, IN(vec3) p_vs, IN(vec3) p_ls) {
  float moved = 8.0f * unit_roundoff * (norm1(p_vs) + norm1(vec3(light.origin)));
  if (!is_positional(light)) return moved;
  return 2.0f * moved / (p_ls.z * p_ls.z);
}

const uint class_receiver = 0u;  // numbered as reference::PixelClass
const uint class_sky = 1u;
const uint class_culled = 2u;
const uint class_outside_cone = 3u;

// What a visible point is to the shadow test. normal_vs points along the geometric normal on the viewer's side, of any
// length. Shading uses the same decision, so that a culled point's light term is exactly zero (6.5). Products and sums
// only, so that C++ and every GPU agree.
SHARED uint receiver_class(IN(LightFrame) light, IN(vec3) p_vs, IN(vec3) normal_vs) {
  if (normal_vs == vec3(0.0f)) return class_culled;  // no side, no light
  PRECISE vec3 to_light = is_positional(light) ? vec3(light.origin) - p_vs : vec3(light.to_light);
  if (is_positional(light)) {
    PRECISE float along =
        -((light.axis_z.x * to_light.x + light.axis_z.y * to_light.y) + light.axis_z.z * to_light.z);
    PRECISE float length2 = (to_light.x * to_light.x + to_light.y * to_light.y) + to_light.z * to_light.z;
    PRECISE float along2 = along * along;
    PRECISE float limit2 = (light.to_light.w * light.to_light.w) * length2;
    if (light.to_light.w >= 0.0f && (!(along > 0.0f) || along2 < limit2)) return class_outside_cone;
  }
  PRECISE float n_dot_l = (normal_vs.x * to_light.x + normal_vs.y * to_light.y) + normal_vs.z * to_light.z;
  if (light.color.w != 0.0f && n_dot_l <= 0.0f) return class_culled;
  return class_receiver;
}

SHARED_END
#endif

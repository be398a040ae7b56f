// SPDX-License-Identifier: MIT
// Morph targets and skins (glTF 2.0, sections 3.7.2.2 and 3.7.3): what becomes of a vertex before an instance places it.
#ifndef IZB_SHARED_DEFORM_H
#define IZB_SHARED_DEFORM_H
#include "shared/camera.h"
SHARED_BEGIN

// Where a joint takes a vertex at rest, as rows; or the sum of several by their weights.
struct JointFrame {
  vec4 row_x;
  vec4 row_y;
  vec4 row_z;
};

// One joint that a vertex follows.
struct InfluenceFrame {
  uint joint;
  float weight;
};

SHARED vec3 morphed(IN(vec3) v, float weight, IN(vec3) difference) {
  PRECISE float x = v.x + weight * difference.x;
  PRECISE float y = v.y + weight * difference.y;
  PRECISE float z = v.z + weight * difference.z;
  return vec3(x, y, z);
}

SHARED vec4 blended(IN(vec4) sum, float weight, IN(vec4) row) {
  PRECISE float x = sum.x + weight * row.x;
  PRECISE float y = sum.y + weight * row.y;
  PRECISE float z = sum.z + weight * row.z;
  PRECISE float w = sum.w + weight * row.w;
  return vec4(x, y, z, w);
}

SHARED void add_joint(OUT(JointFrame) sum, float weight, IN(JointFrame) joint) {
  sum.row_x = blended(sum.row_x, weight, joint.row_x);
  sum.row_y = blended(sum.row_y, weight, joint.row_y);
  sum.row_z = blended(sum.row_z, weight, joint.row_z);
}

SHARED vec3 skinned_position(IN(JointFrame) skin, IN(vec3) p) { return placed(skin.row_x, skin.row_y, skin.row_z, p); }

// Not of unit length. By cofactors: the inverse transpose without a division, so that flat joints do no harm.
SHARED vec3 skinned_normal(IN(JointFrame) skin, IN(vec3) n) {
  vec3 x = vec3(skin.row_x), y = vec3(skin.row_y), z = vec3(skin.row_z);
  vec3 yz = cross(y, z);
  vec3 turned = vec3(dot(yz, n), dot(cross(z, x), n), dot(cross(x, y), n));
  return dot(x, yz) < 0.0f ? -turned : turned;
}

SHARED_END
#endif

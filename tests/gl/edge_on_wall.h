// SPDX-License-Identifier: MIT
// A lamp beside a wall that is seen edge-on: micro-quads of the wall nearly reach the light's plane, where their place
// on the grid is wrong by texels.
#pragma once
#include "gl/frame_fixture.h"

namespace izb::test {

struct EdgeOnWall {
  Scene floor, with_wall;  ///< the floor alone, and both
  Light lamp;
};

/// For a camera at `eye` that looks at `target`.
inline EdgeOnWall edge_on_wall(const glm::vec3& eye, const glm::vec3& target) {
  const glm::vec3 ahead = glm::normalize(target - eye), up(0.0f, 1.0f, 0.0f);
  const glm::vec3 aside = glm::normalize(glm::cross(ahead, up));
  EdgeOnWall made{empty_scene(), {}, point_light(glm::dvec3(eye + 2.5f * ahead))};
  add_soup(made.floor, floor_of(20.0f, 4));
  made.with_wall = made.floor;
  add_soup(made.with_wall, rectangle(eye + 0.05f * aside + 1.0f * ahead - 2.0f * up, 7.0f * ahead, 4.0f * up));
  return made;
}

}  // namespace izb::test

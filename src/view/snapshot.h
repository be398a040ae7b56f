// SPDX-License-Identifier: MIT
// What a finished frame left on the GPU, on the CPU: for the views of single stages, the lens and picking.
#pragma once
#include <optional>
#include <vector>

#include "frame/frame_setup.h"
#include "frame/read_back.h"
#include "frame/samples.h"
#include "shadow/izb/internals.h"
#include "shared/bounds.h"

namespace izb {

/// Of one technique under one light. Arrays of the screen have the top row first; empty where nobody asked for them or
/// the technique has nothing of the kind.
struct Snapshot {
  int width_px = 0, height_px = 0;
  shared::CameraFrame camera;
  shared::LightFrame light;
  Camera camera_ws;  ///< view space is relative to it
  SamplePattern samples;
  GBufferImage gbuffer;
  std::vector<glm::vec3> albedo;             ///< linear
  std::vector<glm::vec3> shading_normal;     ///< view space; 0 where the pixel has none
  std::vector<uint32_t> mask;                ///< a set bit is an occluded sample
  std::vector<uint32_t> truth;               ///< the same by rays
  std::vector<float> list_length;            ///< of the longest list in which the pixel stands
  std::vector<float> tests;                  ///< frustum-triangle tests that the pixel took part in
  std::vector<float> fragments;              ///< of each texel of all layers of the grid, indexed as `built`
  std::vector<shared::LightWindow> windows;  ///< one a layer
  shared::CascadeRange cascades;             ///< where the cascades end; comes with `windows`
  std::vector<uint32_t> first_triangle;      ///< in the frame's numbering, of each instance of the G-buffer's ids
  std::optional<IzbInternals> built;         ///< lists as `build` made them
  std::optional<IzbInternals> left;          ///< lists as `visibility` left them, without what it removed

  size_t size() const { return gbuffer.size(); }
  size_t index(const glm::ivec2& px) const { return size_t(px.y) * size_t(width_px) + size_t(px.x); }
};

}  // namespace izb

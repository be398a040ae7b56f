// SPDX-License-Identifier: MIT
// The frame's matrices, made in double and rounded once. No GL.
#pragma once
#include <vector>

#include "frame/draw_list.h"
#include "frame/samples.h"
#include "scene/scene.h"
#include "shared/gbuffer.h"
#include "shared/light.h"
#include "shared/micro_quad.h"
#include "shared/shade.h"

namespace izb {

/// What a technique asks of the light-space grid.
struct GridRequest {
  int texels = 1;       ///< along one side
  bool nl_cull = true;  ///< leave pixels with N.L <= 0 out of the IZB (6.5)
  int cascades = 1;     ///< one grid each (6.4), 1 to 8
  int table_side = 0;   ///< of the visibility look-up table; 0: none
};

shared::CameraFrame make_camera_frame(const Camera& camera, int width_px, int height_px);

/// Directional lights and spots of a half-angle up to 60 degrees; throws izb::Error for others.
shared::LightFrame make_light_frame(const Camera& camera, const Light& light, const GridRequest& grid);

std::vector<shared::InstanceFrame> make_instance_frames(const Camera& camera, const Scene& scene, const DrawList& list);

std::vector<shared::MaterialFrame> make_materials(const Scene& scene);

shared::SampleFrame make_sample_frame(const SamplePattern& samples, const GridRequest& grid);

shared::ShadeFrame make_shade_frame(const Camera& camera, const Light& light);

/// All triangles of the frame in view space, in the frame's numbering: three vertices a triangle, by the same text as
/// the GPU's vertex stage.
std::vector<glm::vec3> flatten(const Scene& scene, const DrawList& list,
                               const std::vector<shared::InstanceFrame>& instances);

}  // namespace izb

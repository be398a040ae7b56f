// SPDX-License-Identifier: MIT
// The frame's matrices, made in double and rounded once. No GL.
#pragma once
#include <vector>

#include "frame/alpha_maps.h"
#include "frame/draw_list.h"
#include "frame/geometry_windows.h"
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
  /// Every point of a micro-quad stands in the grid, however near to the light: positional lights get a cube of grids.
  bool whole_micro_quads = false;
  double density = 0.0;  ///< texels that a grid uses for each receiver in its window, 0: all of them
  /// Light space stands still in the world; otherwise it turns with the view, so that windows are tight around it.
  bool world_axes = false;
};

/// What a frame's memory is made for.
struct FrameShape {
  int width_px = 0, height_px = 0;
  int faces = 1;  ///< grids for each cascade of the light, 1 or shared::cube_faces
  GeometryWindows geometry{};
};

/// Grids for each cascade that the light takes: one, or six around a point light, a spot of a half-angle above 60
/// degrees, or any positional light where the whole of each micro-quad is asked for.
int grid_faces(const Light& light, const GridRequest& grid);

shared::CameraFrame make_camera_frame(const Camera& camera, int width_px, int height_px);

/// `frame` is the camera's own, for the width of a pixel at the light.
shared::LightFrame make_light_frame(const Camera& camera, const shared::CameraFrame& frame, const Light& light,
                                    const GridRequest& grid);

std::vector<shared::InstanceFrame> make_instance_frames(const Camera& camera, const Scene& scene, const DrawList& list);

std::vector<shared::MaterialFrame> make_materials(const Scene& scene, const AlphaMaps& maps);

shared::SampleFrame make_sample_frame(const SamplePattern& samples, const GridRequest& grid);

/// Whether the picture's exposure must be measured: where a light's strength depends on the distance from it.
bool exposure_is_measured(const std::vector<Light>& lights);
/// By what the colour of each light is multiplied: its strength; of suns alone its share in the sum of all.
std::vector<double> shade_weights(const std::vector<Light>& lights);

shared::ShadeFrame make_shade_frame(const Camera& camera, const Light& light, double weight = 1.0);

/// All triangles of the frame in view space, in the frame's numbering: three vertices a triangle, by the same text as
/// the GPU's vertex stage.
std::vector<glm::vec3> flatten(const Scene& scene, const DrawList& list,
                               const std::vector<shared::InstanceFrame>& instances);

}  // namespace izb

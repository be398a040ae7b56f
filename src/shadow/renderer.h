// SPDX-License-Identifier: MIT
// The spine: gbuffer, bounds, [build, zcull, visibility: the technique's], shade.
#pragma once
#include <optional>

#include "frame/bounds.h"
#include "frame/scene_buffers.h"
#include "frame/shade.h"
#include "frame/uniform_block.h"
#include "shadow/technique.h"

namespace izb {

class Renderer {
 public:
  /// The scene must outlive the renderer; it may be posed anew between frames. Throws izb::Error if the driver refuses
  /// a buffer or a program.
  /// `part_triangles`, for tests: see make_draw_list().
  Renderer(const Scene& scene, const gpu::Capabilities& capabilities, uint32_t part_triangles = largest_part_triangles);
  /// The same over buffers of that scene which several renderers of one context share.
  Renderer(const Scene& scene, const gpu::Capabilities& capabilities, std::shared_ptr<SceneBuffers> buffers);

  /// May be called between any frames, and makes only what is not there already: programs outlive a change of size.
  /// Fixes size, technique and its options, for frames with so many lights, each of which takes no more grids than
  /// these do. Throws izb::Error if the size is beyond the driver's limits, there is too little memory, or the
  /// technique lacks a capability.
  void prepare(Technique& technique, int width_px, int height_px, const std::vector<Light>& lights);

  /// One frame: the G-buffer, a mask for each light, one picture of all. Stage times go to `timers`, summed over the
  /// lights once it collects.
  void render(const Camera& camera, const std::vector<Light>& lights, gpu::StageTimers& timers);

  /// From now on frames whose triangles in view space are those of the frame before keep their number, see
  /// FrameInputs::geometry, and a technique may keep what it built. Off at first: what is built counts as the frame's.
  void keep_geometry(bool keep);
  /// From now on pictures have this exposure; nothing: each measures its own, as at first.
  void expose_as(std::optional<float> exposure) { given_exposure_ = exposure; }

  size_t light_count() const { return inputs_.size(); }
  /// Of the last frame under its light number `light`.
  const FrameInputs& inputs(size_t light = 0) const { return inputs_[light]; }
  const gpu::Texture& mask(size_t light = 0) const { return visibility_[light].mask; }
  /// The words of that mask, top row first. Throws izb::Error where the technique says that they are wrong.
  std::vector<uint32_t> read_mask(size_t light = 0) const;
  const gpu::Texture& picture() const { return shade_.picture(); }
  /// What the lights' strength was multiplied by, so that the picture is neither black nor white.
  float exposure() const { return shade_.read_exposure().scale.x; }

  /// Counts of the last frame under one of its lights, by a frame of their own; and what the technique says of its
  /// lists and of its work. Where another renderer of the same buffers has rendered since, the scene must be posed as
  /// it was.
  Counts count(size_t light = 0, bool unculled = true);
  std::vector<float> list_lengths(size_t light = 0);
  std::vector<uint64_t> list_histogram(size_t light = 0);
  std::vector<float> tests_a_pixel(size_t light = 0);
  std::vector<float> fragments_a_texel(size_t light = 0);
  std::optional<SpeedOfLight> speed_of_light(size_t light, int repeats);

  const BoundsStage& bounds() const { return bounds_; }
  const SceneBuffers& scene_buffers() const { return *buffers_; }
  const std::shared_ptr<SceneBuffers>& shared_scene_buffers() const { return buffers_; }
  /// GPU memory by group: "izb" or the technique's name with the mask, "gbuffer" with the picture, "scene".
  Counts memory() const;
  /// What memory() will be after prepare(), before exact insertion's pool grows.
  gpu::Plans memory_needed(const Technique& technique, int width_px, int height_px,
                           const std::vector<Light>& lights) const;
  /// What there was for all of it at the last prepare().
  const gpu::Room& room() const { return room_; }

  /// All programs that any technique compiles, and the frame's own. Needs no GL.
  static std::vector<gpu::ProgramSpec> program_specs();

 private:
  /// Binds that light of the last frame and fits its windows, as a technique finds them.
  void select(size_t light, gpu::StageTimers& timers);
  /// So that the technique is as that light left it.
  void select_again(size_t light);
  void bind_frame();
  /// Forgets the last frame's triangles, unless they are kept and still the same.
  void renew_geometry();
  void pose(gpu::StageTimers& timers);
  void shade(const Camera& camera, const std::vector<Light>& lights, gpu::StageTimers& timers);

  const Scene& scene_;
  gpu::Capabilities capabilities_;
  std::shared_ptr<SceneBuffers> buffers_;
  Technique* technique_ = nullptr;
  GBufferStage gbuffer_;
  BoundsStage bounds_;
  ShadeStage shade_;
  UniformBlock<shared::CameraFrame> camera_block_;
  UniformBlock<shared::LightFrame> light_block_;
  UniformBlock<shared::ShadeFrame> shade_block_;
  UniformBlock<shared::SampleFrame> samples_block_;
  gpu::Room room_;
  std::vector<Visibility> visibility_;  ///< one a light
  std::vector<FrameInputs> inputs_;     ///< one a light
  std::vector<std::string> faults_;     ///< of each light's mask, empty: none
  FrameInputs common_;                  ///< what all lights share
  size_t selected_ = 0;
  uint64_t placed_ = 0;  ///< SceneBuffers::updates() after its last frame's
  std::vector<shared::InstanceFrame> instances_;
  std::vector<glm::vec3> triangles_vs_;  ///< of the last frame, once asked for
  bool keeps_geometry_ = false;
  std::vector<std::byte> placement_;  ///< all that the kept triangles follow from, but for what is constant in a scene
  std::optional<float> given_exposure_;
};

}  // namespace izb

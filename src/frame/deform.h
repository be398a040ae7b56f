// SPDX-License-Identifier: MIT
// Vertices that morph targets and skins move: by a pass before all others on the GPU, by the same text on the CPU.
#pragma once
#include <vector>

#include "frame/draw_list.h"
#include "gpu/glsl_front_end.h"
#include "gpu/memory.h"
#include "gpu/objects.h"
#include "gpu/program.h"
#include "scene/scene.h"
#include "shared/deform.h"

namespace izb {

/// One a joint of the instance's skin, from the mesh at rest to the space that instance.world_from_object places; empty
/// without a skin.
std::vector<shared::JointFrame> make_joint_frames(const Scene& scene, const Instance& instance);

/// An instance's vertices as the GPU has them: of one that does not deform the mesh's own.
std::vector<glm::vec3> deformed_positions(const Scene& scene, const Instance& instance);

/// Buffers of what deforms at rest, and the pass that deforms it.
class DeformStage {
 public:
  DeformStage() = default;
  /// Uploads. `list` must be the scene's.
  DeformStage(const Scene& scene, const DrawList& list);

  /// Whether anything deforms.
  explicit operator bool() const { return !parts_.empty(); }
  /// Writes the scene's deforming instances, as posed, into the ranges of the joined buffers that the list gives them.
  void render(const Scene& scene, const gpu::Buffer& positions, const gpu::Buffer& normals);

  size_t bytes() const;
  /// What bytes() will be.
  static gpu::Plan memory_needed(const Scene& scene, const DrawList& list);
  static gpu::ProgramSpec program_spec();

 private:
  /// A stretch of a buffer, for glBindBufferRange.
  struct Range {
    size_t offset_bytes = 0, size_bytes = 0;
  };
  /// One instance that deforms, and where what moves it stands.
  struct Part {
    uint32_t instance = 0, first_vertex = 0, vertex_count = 0;
    Range rest, targets, influences, joints, morph_weights;
  };
  /// Where the parts stand, and how much that is.
  struct Layout {
    std::vector<Part> parts;
    size_t rest_bytes = 0, targets_bytes = 0, influences_bytes = 0, joints_bytes = 0, morph_weights_bytes = 0;
  };
  static Layout lay_out(const Scene& scene, const DrawList& list);
  void upload(const Scene& scene, const Part& part);

  std::vector<Part> parts_;
  gpu::Buffer rest_positions_, rest_normals_, targets_, influences_, joints_, morph_weights_;
  gpu::Program program_;
};

}  // namespace izb

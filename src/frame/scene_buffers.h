// SPDX-License-Identifier: MIT
// A scene on the GPU: joined vertex and index buffers, textures, and the draw calls over them.
#pragma once
#include <functional>

#include "frame/deform.h"
#include "frame/frame_setup.h"
#include "gpu/capabilities.h"
#include "gpu/memory.h"
#include "gpu/objects.h"

namespace izb {

class SceneBuffers {
 public:
  /// Uploads. Throws izb::Error, before, if there is no room or a buffer or texture is larger than the driver takes.
  SceneBuffers(const Scene& scene, DrawList list, const gpu::Capabilities& capabilities);

  const DrawList& draw_list() const { return list_; }
  /// The scene as it is posed now: placements, and vertices that deform.
  void update(const Scene& scene, const std::vector<shared::InstanceFrame>& instances);
  /// How often: tells a renderer that shares the scene whether another has placed it since.
  uint64_t updates() const { return updates_; }
  /// Whether update() has vertices to deform.
  bool deforms() const { return static_cast<bool>(deform_); }
  const gpu::Buffer& positions() const { return positions_; }
  const gpu::Buffer& normals() const { return normals_; }

  /// Draws it once, base-colour textures bound group by group, for the G-buffer.
  void draw_with_textures(Drawn drawn) const;
  /// Draws each of its triangles once: attributes position, uv and instance, for techniques that cast shadows.
  void draw_casters(Drawn drawn) const;
  /// The same for techniques that take triangles by their numbers from storage blocks, which it binds: calls `take`
  /// with [first, end) in the frame's numbering, at most `most` at once, until it has had all.
  void for_casters(Drawn drawn, uint32_t most, const std::function<void(uint32_t first, uint32_t end)>& take) const;
  /// Binds instances, positions, indices and materials as storage blocks; where anything is masked, also what its alpha
  /// takes.
  void bind_storage() const;

  const GeometryWindows& windows() const { return windows_; }

  /// If set, called after each part that a software renderer has drawn; what it throws gives up the frame.
  std::function<void()> between_draws;

  size_t bytes() const;
  /// What bytes() will be.
  static gpu::Plan memory_needed(const Scene& scene, const DrawList& list);

 private:
  void upload_geometry(const Scene& scene);
  void upload_materials(const Scene& scene);
  void upload_textures(const Scene& scene);
  void draw(Drawn drawn, bool with_textures) const;

  DrawList list_;
  GeometryWindows windows_;
  bool throttled_;
  uint64_t updates_ = 0;
  gpu::Buffer positions_, normals_, uvs_, indices_, instance_ids_, commands_, instances_, materials_;
  DeformStage deform_;
  gpu::VertexArray vertex_array_;
  gpu::Texture white_;
  gpu::BufferTexture alpha_maps_, uv_texels_;
  std::vector<gpu::Texture> textures_;
  std::vector<gpu::Sampler> samplers_;
};

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "frame/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "shared/bindings.h"

namespace izb {
namespace {

/// Whether any mesh has normals, texture coordinates; where none has, there is no buffer for them.
template <typename T>
bool any_has(const Scene& scene, std::vector<T> Mesh::*member) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                     [&](const Mesh& mesh) { return !(mesh.*member).empty(); });
}

bool any_deforms(const Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [](const Instance& i) { return i.deforms(); });
}

uint64_t normal_count(const Scene& scene, const DrawList& list) {
  return any_has(scene, &Mesh::normals) || any_deforms(scene) ? list.vertex_count : 0;
}

uint64_t uv_count(const Scene& scene, const DrawList& list) {
  return any_has(scene, &Mesh::uvs) || has_masked(list) ? list.vertex_count : 0;
}

/// Joins one array of every mesh, straight from where it stands; a mesh without it gets zeros. `deformed`: also for the
/// instances that deform, as at rest.
template <typename T>
gpu::Buffer join(const std::string& label, const Scene& scene, const DrawList& list, std::vector<T> Mesh::*member,
                 bool deformed) {
  gpu::Buffer all(label, list.vertex_count * sizeof(T));
  const auto copy = [&](size_t mesh, size_t first_vertex) {
    const std::vector<T>& part = scene.meshes[mesh].*member;
    const size_t first_byte = first_vertex * sizeof(T);
    if (part.empty())
      all.fill(0, first_byte, scene.meshes[mesh].positions.size() * sizeof(T));
    else
      all.update(first_byte, part.size() * sizeof(T), part.data());
  };
  for (size_t m = 0; m < scene.meshes.size(); ++m)
    if (list.first_vertex[m] != DrawList::no_vertex) copy(m, list.first_vertex[m]);
  if (deformed)
    for (const DrawPart& part : list.parts)
      if (const Instance& instance = scene.instances[part.instance]; instance.deforms() && part.mesh_triangle == 0)
        copy(instance.mesh, part.base_vertex);
  return all;
}

GLint gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::mirrored_repeat:
      return GL_MIRRORED_REPEAT;
    default:
      return GL_CLAMP_TO_EDGE;
  }
}

int levels_of(const Texture& t) {
  return 1 + static_cast<int>(std::floor(std::log2(std::max(t.width_px, t.height_px))));
}

/// llvmpipe bins triangles faster than it rasterises them and keeps all that wait, a few hundred bytes each: of ten
/// million that was 2 GB. Where that counts, drawing waits for what was drawn two steps before. Where frames are given
/// up between draws, every draw is waited for: llvmpipe seems to keep what a draw had read and drawn to until it next
/// has as many draws in flight, which for a person who tries everything adds up to a gigabyte of grids that are long
/// gone.
class Throttle {
 public:
  Throttle(bool active, uint64_t step_triangles, bool lags)
      : active_(active), step_triangles_(step_triangles), lags_(lags) {}
  ~Throttle() {
    for (const GLsync fence : fences_)
      if (fence) glDeleteSync(fence);
  }
  Throttle(const Throttle&) = delete;
  Throttle& operator=(const Throttle&) = delete;

  void drawn(uint64_t triangles) {
    waiting_ += triangles;
    if (!active_ || waiting_ < step_triangles_) return;
    waiting_ = 0;
    if (!lags_) return glFinish();
    if (fences_[0]) {
      glClientWaitSync(fences_[0], GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
      glDeleteSync(fences_[0]);
    }
    fences_[0] = fences_[1];
    fences_[1] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
  }

 private:
  const bool active_;
  const uint64_t step_triangles_;
  const bool lags_;
  uint64_t waiting_ = 0;
  GLsync fences_[2] = {nullptr, nullptr};
};

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene, DrawList list, const gpu::Capabilities& capabilities)
    : list_(std::move(list)),
      windows_(list_.vertex_count * sizeof(glm::vec3), list_.index_count * sizeof(uint32_t), capabilities),
      throttled_(capabilities.software) {
  gpu::expect_room({{"scene '" + scene.name + "'", memory_needed(scene, list_)}}, gpu::memory_room(capabilities),
                   capabilities);
  upload_geometry(scene);
  upload_materials(scene);
  upload_textures(scene);
}

void SceneBuffers::upload_geometry(const Scene& scene) {
  positions_ = join("positions", scene, list_, &Mesh::positions, false);
  if (normal_count(scene, list_) > 0) normals_ = join("normals", scene, list_, &Mesh::normals, false);
  if (uv_count(scene, list_) > 0) uvs_ = join("uvs", scene, list_, &Mesh::uvs, true);
  deform_ = DeformStage(scene, list_);
  indices_ = gpu::Buffer("indices", list_.index_count * sizeof(uint32_t));
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const std::vector<uint32_t>& part = scene.meshes[m].indices;
    if (!part.empty())
      indices_.update(list_.first_index[m] * sizeof(uint32_t), part.size() * sizeof(uint32_t), part.data());
  }
  std::vector<uint32_t> ids(list_.parts.size());
  std::iota(ids.begin(), ids.end(), 0u);
  instance_ids_ = gpu::Buffer("instance ids", ids);
  commands_ = gpu::Buffer("draw commands", list_.commands);
  instances_ = gpu::Buffer("instances", list_.parts.size() * sizeof(shared::InstanceFrame));

  vertex_array_ = gpu::VertexArray("scene");
  const GLuint va = vertex_array_.name();
  const auto floats = [&](GLuint attribute, const gpu::Buffer& buffer, GLint components) {
    glVertexArrayVertexBuffer(va, attribute, buffer.name(), 0, components * GLsizei{sizeof(float)});
    glVertexArrayAttribFormat(va, attribute, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(va, attribute, attribute);
    glEnableVertexArrayAttrib(va, attribute);
  };
  floats(ATTRIBUTE_POSITION, positions_, 3);
  if (normals_) floats(ATTRIBUTE_NORMAL, normals_, 3);  // else GL's own value of an attribute that is off: zeros
  if (uvs_) floats(ATTRIBUTE_UV, uvs_, 2);
  glVertexArrayVertexBuffer(va, ATTRIBUTE_INSTANCE, instance_ids_.name(), 0, sizeof(uint32_t));
  glVertexArrayAttribIFormat(va, ATTRIBUTE_INSTANCE, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(va, ATTRIBUTE_INSTANCE, ATTRIBUTE_INSTANCE);
  glVertexArrayBindingDivisor(va, ATTRIBUTE_INSTANCE, 1);
  glEnableVertexArrayAttrib(va, ATTRIBUTE_INSTANCE);
  glVertexArrayElementBuffer(va, indices_.name());
}

void SceneBuffers::upload_materials(const Scene& scene) {
  const AlphaMaps maps = plan_alpha_maps(scene);
  materials_ = gpu::Buffer("materials", make_materials(scene, maps));
  if (maps.texel_count == 0) return;
  alpha_maps_ = gpu::BufferTexture("alpha maps", join_alpha_maps(scene, maps));
  if (has_masked(list_)) uv_texels_ = gpu::BufferTexture("uvs", GL_RG32F, uvs_);
}

void SceneBuffers::upload_textures(const Scene& scene) {
  white_ = gpu::Texture("white", GL_SRGB8_ALPHA8, 1, 1);
  const uint8_t white[4] = {255, 255, 255, 255};
  white_.clear(GL_RGBA, GL_UNSIGNED_BYTE, white);
  for (const Texture& t : scene.textures) {
    gpu::Texture texture("base colour " + t.name, GL_SRGB8_ALPHA8, t.width_px, t.height_px, levels_of(t));
    glTextureSubImage2D(texture.name(), 0, 0, 0, t.width_px, t.height_px, GL_RGBA, GL_UNSIGNED_BYTE, t.rgba.data());
    glGenerateTextureMipmap(texture.name());
    gpu::Sampler sampler("base colour " + t.name);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, gl_wrap(t.wrap_u));
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, gl_wrap(t.wrap_v));
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER,
                        t.nearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, t.nearest ? GL_NEAREST : GL_LINEAR);
    textures_.push_back(std::move(texture));
    samplers_.push_back(std::move(sampler));
  }
}

void SceneBuffers::update(const Scene& scene, const std::vector<shared::InstanceFrame>& instances) {
  ++updates_;
  instances_.update(0, instances.size() * sizeof(shared::InstanceFrame), instances.data());
  if (deform_) deform_.render(scene, positions_, normals_);
}

void SceneBuffers::bind_storage() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_INSTANCES, instances_.name());
  windows_.bind(BIND_POSITIONS, BIND_MORE_POSITIONS, positions_, windows_.positions);
  windows_.bind(BIND_INDICES, BIND_MORE_INDICES, indices_, windows_.indices);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_MATERIALS, materials_.name());
  if (!uv_texels_) return;
  glBindTextureUnit(UNIT_ALPHA, alpha_maps_.name());
  glBindTextureUnit(UNIT_UVS, uv_texels_.name());
}

void SceneBuffers::draw(Drawn drawn, bool with_textures) const {
  bind_storage();
  glBindVertexArray(vertex_array_.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
  Throttle throttle(throttled_, between_draws ? 1 : largest_part_triangles, !between_draws);
  const auto draw_commands = [](uint32_t first, uint32_t count) {
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(uintptr_t(first) * sizeof(DrawCommand)),
                                static_cast<GLsizei>(count), 0);
  };
  if (!with_textures && !throttled_) {
    const uint32_t first = drawn == Drawn::masked ? list_.opaque_commands : 0;
    const uint32_t end = drawn == Drawn::opaque ? list_.opaque_commands : static_cast<uint32_t>(list_.commands.size());
    return draw_commands(first, end - first);
  }
  for (const DrawGroup& group : list_.groups) {
    if (drawn != Drawn::all && group.masked != (drawn == Drawn::masked)) continue;
    if (with_textures) {
      const bool textured = group.texture >= 0;
      glBindTextureUnit(UNIT_BASE_COLOR, textured ? textures_[group.texture].name() : white_.name());
      glBindSampler(UNIT_BASE_COLOR, textured ? samplers_[group.texture].name() : 0);
    }
    draw_commands(group.first_command, group.command_count);
    throttle.drawn(group.triangle_count);
    if (between_draws) between_draws();
  }
  if (with_textures) glBindSampler(UNIT_BASE_COLOR, 0);
}

void SceneBuffers::draw_with_textures(Drawn drawn) const {
  draw(drawn, true);
}

void SceneBuffers::draw_casters(Drawn drawn) const {
  draw(drawn, false);
}

void SceneBuffers::for_casters(Drawn drawn, uint32_t most, const std::function<void(uint32_t, uint32_t)>& take) const {
  bind_storage();
  Throttle throttle(throttled_, between_draws ? 1 : largest_part_triangles, !between_draws);
  const uint32_t opaque = opaque_triangles(list_);
  const uint32_t end = drawn == Drawn::opaque ? opaque : list_.triangle_count;
  // Between them a frame can be given up; and a software renderer need not keep all that they leave to its raster.
  const uint32_t step = std::min(most, between_draws ? list_.part_triangles : throttled_ ? 1u << 18 : most);
  for (uint32_t first = drawn == Drawn::masked ? opaque : 0; first < end; first += std::min(step, end - first)) {
    const uint32_t count = std::min(step, end - first);
    take(first, first + count);
    throttle.drawn(count);
    if (between_draws) between_draws();
  }
}

size_t SceneBuffers::bytes() const {
  size_t sum = positions_.bytes() + normals_.bytes() + uvs_.bytes() + indices_.bytes() + instance_ids_.bytes() +
               commands_.bytes() + instances_.bytes() + materials_.bytes() + white_.bytes() + deform_.bytes() +
               alpha_maps_.bytes();
  for (const gpu::Texture& t : textures_) sum += t.bytes();
  return sum;
}

gpu::Plan SceneBuffers::memory_needed(const Scene& scene, const DrawList& list) {
  using Kind = gpu::Planned::Kind;
  gpu::Plan plan;
  const auto buffer = [&](const char* part, Kind kind, uint64_t count, uint64_t bytes_each) {
    plan.push_back(gpu::planned_buffer(part, kind, count * bytes_each, {}));
  };
  // Those that shaders read by number are bound in windows: no storage block needs to hold them whole.
  buffer("positions", Kind::other_buffer, list.vertex_count, sizeof(glm::vec3));
  if (const uint64_t normals = normal_count(scene, list))
    buffer("normals", Kind::other_buffer, normals, sizeof(glm::vec3));
  if (const uint64_t uvs = uv_count(scene, list)) {
    buffer("uvs", Kind::other_buffer, uvs, sizeof(glm::vec2));
    if (has_masked(list)) plan.back() = gpu::planned_buffer_texture("uvs", GL_RG32F, uvs, {});
  }
  buffer("indices", Kind::other_buffer, list.index_count, sizeof(uint32_t));
  buffer("instance ids", Kind::other_buffer, list.parts.size(), sizeof(uint32_t));
  buffer("draw commands", Kind::other_buffer, list.commands.size(), sizeof(DrawCommand));
  buffer("instances", Kind::storage_buffer, list.parts.size(), sizeof(shared::InstanceFrame));
  buffer("materials", Kind::storage_buffer, scene.materials.size(), sizeof(shared::MaterialFrame));
  for (gpu::Planned& part : DeformStage::memory_needed(scene, list)) plan.push_back(std::move(part));
  if (const uint64_t texels = plan_alpha_maps(scene).texel_count; texels > 0)
    plan.push_back(gpu::planned_buffer_texture("alpha maps", GL_R8UI, texels, {}));
  plan.push_back(gpu::planned_texture("white", GL_SRGB8_ALPHA8, 1, 1, {}));
  for (const Texture& t : scene.textures)
    plan.push_back(
        gpu::planned_texture("base colour " + t.name, GL_SRGB8_ALPHA8, t.width_px, t.height_px, {}, 1, levels_of(t)));
  return plan;
}

}  // namespace izb

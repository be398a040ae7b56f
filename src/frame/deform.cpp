// SPDX-License-Identifier: MIT
#include "frame/deform.h"

#include <algorithm>
#include <map>

#include "shared/bindings.h"

namespace izb {
namespace {

/// No driver asks for more (GL 4.5, table 23.64); the draw list aligns the deformed vertices likewise.
constexpr size_t range_alignment_bytes = 256;
static_assert(deformed_vertex_alignment * sizeof(glm::vec3) % range_alignment_bytes == 0);

size_t aligned(size_t bytes) {
  return (std::max<size_t>(bytes, 1) + range_alignment_bytes - 1) / range_alignment_bytes * range_alignment_bytes;
}

/// What the shader reads of the mesh's targets: positions, normals; of each.
std::vector<glm::vec3> target_words(const Mesh& mesh) {
  std::vector<glm::vec3> words;
  const auto append = [&](const std::vector<glm::vec3>& part) {
    words.insert(words.end(), part.begin(), part.end());
    words.resize(words.size() + mesh.positions.size() - part.size(), glm::vec3(0.0f));
  };
  for (const MorphTarget& target : mesh.targets) {
    append(target.positions);
    append(target.normals);
  }
  return words;
}

std::vector<shared::InfluenceFrame> influence_frames(const Mesh& mesh) {
  std::vector<shared::InfluenceFrame> frames(mesh.joints.size());
  for (size_t i = 0; i < frames.size(); ++i) frames[i] = {mesh.joints[i], mesh.weights[i]};
  return frames;
}

template <typename T>
void upload_to(gpu::Buffer& buffer, size_t offset_bytes, const std::vector<T>& data) {
  if (!data.empty()) buffer.update(offset_bytes, data.size() * sizeof(T), data.data());
}

}  // namespace

std::vector<shared::JointFrame> make_joint_frames(const Scene& scene, const Instance& instance) {
  if (instance.skin < 0) return {};
  const glm::dmat4 object_from_world = glm::inverse(instance.world_from_object);
  std::vector<shared::JointFrame> frames;
  for (const glm::dmat4& world_from_bind : scene.skins[static_cast<size_t>(instance.skin)].world_from_bind) {
    const glm::mat4 rows = glm::mat4(glm::transpose(object_from_world * world_from_bind));
    frames.push_back({rows[0], rows[1], rows[2]});
  }
  return frames;
}

std::vector<glm::vec3> deformed_positions(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  std::vector<glm::vec3> positions = mesh.positions;
  for (size_t t = 0; t < instance.morph_weights.size(); ++t) {
    if (instance.morph_weights[t] == 0.0f || mesh.targets[t].positions.empty()) continue;
    for (size_t i = 0; i < positions.size(); ++i)
      positions[i] = shared::morphed(positions[i], instance.morph_weights[t], mesh.targets[t].positions[i]);
  }
  const std::vector<shared::JointFrame> joints = make_joint_frames(scene, instance);
  if (joints.empty()) return positions;
  for (size_t i = 0; i < positions.size(); ++i) {
    shared::JointFrame skin{glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f)};
    for (size_t k = i * mesh.influences; k < (i + 1) * mesh.influences; ++k)
      shared::add_joint(skin, mesh.weights[k], joints[mesh.joints[k]]);
    positions[i] = shared::skinned_position(skin, positions[i]);
  }
  return positions;
}

DeformStage::Layout DeformStage::lay_out(const Scene& scene, const DrawList& list) {
  Layout layout;
  std::map<uint32_t, Part> of_mesh;  // instances share what their mesh is at rest
  std::map<int, Range> of_skin;
  const auto take = [](size_t& end, size_t bytes) {
    const Range range{end, aligned(bytes)};
    end += range.size_bytes;
    return range;
  };
  for (const DrawPart& drawn : list.parts) {
    const Instance& instance = scene.instances[drawn.instance];
    if (!instance.deforms() || drawn.mesh_triangle > 0) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto [it, is_new] = of_mesh.try_emplace(instance.mesh);
    if (is_new) {
      const size_t vertices = mesh.positions.size();
      it->second.rest = take(layout.rest_bytes, vertices * sizeof(glm::vec3));
      it->second.targets = take(layout.targets_bytes, 2 * mesh.targets.size() * vertices * sizeof(glm::vec3));
      it->second.influences = take(layout.influences_bytes, mesh.joints.size() * sizeof(shared::InfluenceFrame));
    }
    Part part = it->second;
    part.instance = drawn.instance;
    part.first_vertex = drawn.base_vertex;
    part.vertex_count = static_cast<uint32_t>(mesh.positions.size());
    part.morph_weights = take(layout.morph_weights_bytes, instance.morph_weights.size() * sizeof(float));
    const auto [skin, is_new_skin] = of_skin.try_emplace(instance.skin);
    if (is_new_skin) {
      const size_t joints = instance.skin < 0 ? 0 : scene.skins[static_cast<size_t>(instance.skin)].joints.size();
      skin->second = take(layout.joints_bytes, joints * sizeof(shared::JointFrame));
    }
    part.joints = skin->second;
    layout.parts.push_back(part);
  }
  return layout;
}

DeformStage::DeformStage(const Scene& scene, const DrawList& list) {
  const Layout layout = lay_out(scene, list);
  parts_ = layout.parts;
  if (parts_.empty()) return;
  rest_positions_ = gpu::Buffer("rest positions", layout.rest_bytes);
  rest_normals_ = gpu::Buffer("rest normals", layout.rest_bytes);
  targets_ = gpu::Buffer("morph targets", layout.targets_bytes);
  influences_ = gpu::Buffer("joint influences", layout.influences_bytes);
  joints_ = gpu::Buffer("joints", layout.joints_bytes);
  morph_weights_ = gpu::Buffer("morph weights", layout.morph_weights_bytes);
  program_ = gpu::Program(program_spec());
  uint32_t last_mesh = ~0u;
  for (const Part& part : parts_) {
    const uint32_t mesh = scene.instances[part.instance].mesh;
    if (mesh != last_mesh) upload(scene, part);  // the list keeps instances of one mesh together
    last_mesh = mesh;
  }
}

void DeformStage::upload(const Scene& scene, const Part& part) {
  const Mesh& mesh = scene.meshes[scene.instances[part.instance].mesh];
  upload_to(rest_positions_, part.rest.offset_bytes, mesh.positions);
  upload_to(rest_normals_, part.rest.offset_bytes,
            mesh.normals.empty() ? std::vector<glm::vec3>(mesh.positions.size(), glm::vec3(0.0f)) : mesh.normals);
  upload_to(targets_, part.targets.offset_bytes, target_words(mesh));
  upload_to(influences_, part.influences.offset_bytes, influence_frames(mesh));
}

void DeformStage::render(const Scene& scene, const gpu::Buffer& positions, const gpu::Buffer& normals) {
  const auto bind = [](GLuint binding, const gpu::Buffer& buffer, const Range& range) {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(range.offset_bytes),
                      static_cast<GLsizeiptr>(range.size_bytes));
  };
  program_.use();
  for (const Part& part : parts_) {
    const Instance& instance = scene.instances[part.instance];
    upload_to(joints_, part.joints.offset_bytes, make_joint_frames(scene, instance));
    upload_to(morph_weights_, part.morph_weights.offset_bytes, instance.morph_weights);
  }
  for (const Part& part : parts_) {
    const Instance& instance = scene.instances[part.instance];
    const size_t vertex_bytes = sizeof(glm::vec3);
    const Range out{part.first_vertex * vertex_bytes, part.vertex_count * vertex_bytes};
    bind(BIND_REST_POSITIONS, rest_positions_, part.rest);
    bind(BIND_REST_NORMALS, rest_normals_, part.rest);
    bind(BIND_TARGETS, targets_, part.targets);
    bind(BIND_INFLUENCES, influences_, part.influences);
    bind(BIND_JOINTS, joints_, part.joints);
    bind(BIND_MORPH_WEIGHTS, morph_weights_, part.morph_weights);
    bind(BIND_DEFORMED_POSITIONS, positions, out);
    bind(BIND_DEFORMED_NORMALS, normals, out);
    glUniform1ui(0, part.vertex_count);
    glUniform1ui(1, instance.skin >= 0 ? scene.meshes[instance.mesh].influences : 0);
    glUniform1ui(2, static_cast<GLuint>(instance.morph_weights.size()));
    // Rows of groups: one alone may be longer than a driver takes.
    constexpr int groups_a_row = 1024, vertices_a_group = 64, row = groups_a_row * vertices_a_group;
    program_.dispatch(std::min<int>(static_cast<int>(part.vertex_count), row),
                      (static_cast<int>(part.vertex_count) + row - 1) / row, vertices_a_group, 1);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

size_t DeformStage::bytes() const {
  return rest_positions_.bytes() + rest_normals_.bytes() + targets_.bytes() + influences_.bytes() + joints_.bytes() +
         morph_weights_.bytes();
}

gpu::Plan DeformStage::memory_needed(const Scene& scene, const DrawList& list) {
  const Layout layout = lay_out(scene, list);
  if (layout.parts.empty()) return {};
  // Bound in ranges, so that no driver's limit for a storage block counts for the whole.
  constexpr auto kind = gpu::Planned::Kind::other_buffer;
  return {gpu::planned_buffer("rest positions", kind, layout.rest_bytes, {}),
          gpu::planned_buffer("rest normals", kind, layout.rest_bytes, {}),
          gpu::planned_buffer("morph targets", kind, layout.targets_bytes, {}),
          gpu::planned_buffer("joint influences", kind, layout.influences_bytes, {}),
          gpu::planned_buffer("joints", kind, layout.joints_bytes, {}),
          gpu::planned_buffer("morph weights", kind, layout.morph_weights_bytes, {})};
}

gpu::ProgramSpec DeformStage::program_spec() {
  return {"deform", {"frame/0_deform.comp.glsl"}, {}};
}

}  // namespace izb

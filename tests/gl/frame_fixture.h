// SPDX-License-Identifier: MIT
// Small scenes made by code, rendered by the spine, and their masks by other means.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "frame/read_back.h"
#include "gl/gl_test.h"
#include "reference/embree.h"
#include "reference/settle.h"
#include "scene/view.h"
#include "shadow/ray_traced/receivers.h"
#include "shadow/renderer.h"
#include "shared/coverage.h"
#include "shared/hits.h"
#include "shared/occlusion.h"
#include "shared_fixture.h"

namespace izb::test {

inline Scene empty_scene() {
  Scene scene;
  scene.name = "test";
  scene.materials.emplace_back();
  return scene;
}

/// Adds triangles, three positions each, as one mesh placed by `world_from_object`.
inline void add_soup(Scene& scene, const std::vector<glm::vec3>& positions,
                     const glm::dmat4& world_from_object = glm::dmat4(1.0)) {
  Mesh mesh;
  mesh.positions = positions;
  for (uint32_t i = 0; i < positions.size(); ++i) mesh.indices.push_back(i);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({static_cast<uint32_t>(scene.meshes.size() - 1), world_from_object});
}

inline std::vector<glm::vec3> rectangle(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  return {corner, corner + u, corner + u + v, corner, corner + u + v, corner + v};
}

/// A floor of side `size` at height 0, finely cut or as two triangles.
inline std::vector<glm::vec3> floor_of(float size, int cuts = 1) {
  std::vector<glm::vec3> all;
  const float step = size / float(cuts);
  for (int i = 0; i < cuts; ++i)
    for (int k = 0; k < cuts; ++k) {
      const auto part =
          rectangle({-0.5f * size + step * float(i), 0.0f, -0.5f * size + step * float(k)}, {0, 0, step}, {step, 0, 0});
      all.insert(all.end(), part.begin(), part.end());
    }
  return all;
}

/// A floor and random triangles, large and small, some through the floor.
inline Scene tangle(uint32_t seed, int count) {
  Scene scene = empty_scene();
  add_soup(scene, floor_of(12.0f, 3));
  Random random(seed);
  std::vector<glm::vec3> soup;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at = random.point(3.0) + glm::dvec3(0, 1.5, 0);
    const double size = i % 10 == 0 ? 3.0 : i % 3 == 0 ? 0.6 : 0.1;
    for (int k = 0; k < 3; ++k) soup.emplace_back(at + random.point(size));
  }
  add_soup(scene, soup);
  return scene;
}

/// The alpha masks of a frame's triangles, as the shaders read them.
struct ShaderMasks {
  std::vector<shared::MaterialFrame> materials;
  std::vector<uint8_t> texels;
  std::vector<uint32_t> material_of;             ///< of each triangle
  std::vector<std::array<glm::vec2, 3>> uvs_of;  ///< of each triangle's corners

  ShaderMasks() = default;
  ShaderMasks(const Scene& scene, const DrawList& list) {
    const AlphaMaps maps = plan_alpha_maps(scene);
    materials = make_materials(scene, maps);
    texels = join_alpha_maps(scene, maps);
    for (const DrawPart& part : list.parts) {
      const Mesh& mesh = scene.meshes[scene.instances[part.instance].mesh];
      const size_t first = 3 * size_t(part.mesh_triangle), end = first + 3 * size_t(part.triangle_count);
      for (size_t i = first; i < end; i += 3) {
        material_of.push_back(mesh.material);
        const auto uv = [&](size_t k) { return mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[mesh.indices[i + k]]; };
        uvs_of.push_back({uv(0), uv(1), uv(2)});
      }
    }
  }

  bool masked(size_t triangle) const {
    return triangle < material_of.size() && shared::is_masked(materials[material_of[triangle]]);
  }
  bool is_there(size_t triangle, const glm::dvec2& texel) const {
    const shared::AlphaMap map = shared::alpha_map(materials[material_of[triangle]]);
    const shared::AlphaTexels t = shared::alpha_texels(map, texel);
    const glm::vec4 alpha(texels.at(size_t(t.index.x)), texels.at(size_t(t.index.y)), texels.at(size_t(t.index.z)),
                          texels.at(size_t(t.index.w)));
    return shared::passes_cutoff(map, alpha, t.between);
  }
  shared::TexelCorners corners(size_t triangle, const std::array<glm::vec2, 3>& uv) const {
    const shared::MaterialFrame& m = materials[material_of[triangle]];
    return {shared::texel_position(m, uv[0]), shared::texel_position(m, uv[1]), shared::texel_position(m, uv[2])};
  }
};

/// One frame and everything read back, top row first.
struct Frame {
  std::vector<uint32_t> mask;
  GBufferImage gbuffer;
  FrameInputs inputs;
  shared::LightWindow window;                ///< of the first layer
  std::vector<shared::LightWindow> windows;  ///< of each layer
  shared::CascadeRange range;
  std::vector<glm::vec3> triangles_vs;
  reference::Triangles triangles;  ///< the same, with their alpha masks
  ShaderMasks masks;
  reference::Receivers receivers;
  reference::LightPoint light;
  Counts counts;
  std::vector<float> list_lengths;

  uint64_t count(const std::string& name) const {
    for (const auto& [key, value] : counts)
      if (key == name) return value;
    ADD_FAILURE() << "no count " << name;
    return 0;
  }
};

/// Of whole numbers, as heat maps hold them.
inline uint64_t sum_of(const std::vector<float>& values) {
  uint64_t all = 0;
  for (const float value : values) all += static_cast<uint64_t>(value);
  return all;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

inline Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

inline void set_options(Technique& technique, const Settings& settings) {
  const OptionSet options = technique.options();
  for (const auto& [name, value] : with({{"spp", "1"}}, settings)) {
    bool known = false;
    for (const Option& option : options.options())
      if (option.name == name) option.set(value), known = true;
    EXPECT_TRUE(known) << "no option " << name;
  }
}

/// Renders by a renderer that was prepared for the technique, and reads everything back.
inline Frame render_frame(Renderer& renderer, Technique& technique, const Camera& camera, const Light& light) {
  gpu::StageTimers timers(true);
  renderer.render(camera, {light}, timers);
  Frame frame;
  frame.mask = renderer.read_mask();
  frame.inputs = renderer.inputs();
  const int layers = technique.grid().cascades * static_cast<int>(frame.inputs.light.grid.z);
  for (int i = 0; i < layers; ++i) frame.windows.push_back(renderer.bounds().read_window(i));
  frame.window = frame.windows[0];
  frame.range = renderer.bounds().read_cascades();
  frame.gbuffer = read_gbuffer(*frame.inputs.gbuffer);
  frame.triangles_vs = frame.inputs.triangles_vs();
  frame.triangles = make_triangles(frame.inputs);
  if (frame.inputs.masked_casters) frame.masks = ShaderMasks(*frame.inputs.scene, *frame.inputs.draw_list);
  frame.receivers = make_receivers(frame.gbuffer, frame.inputs);
  frame.light = make_light_point(frame.inputs.light);
  if (std::vector<float> lengths = technique.list_lengths(frame.inputs); !lengths.empty())
    frame.list_lengths = flip_rows(std::move(lengths), frame.gbuffer.width_px, frame.gbuffer.height_px);
  frame.counts = renderer.count();
  return frame;
}

inline Frame render_frame(const Scene& scene, const Camera& camera, const Light& light, int width_px, int height_px,
                          const Settings& settings, Technique& technique) {
  set_options(technique, settings);
  Renderer renderer(scene, capabilities());
  renderer.prepare(technique, width_px, height_px, {light});
  return render_frame(renderer, technique, camera, light);
}

inline Frame render_frame(const Scene& scene, const Camera& camera, const Light& light, int width_px, int height_px,
                          const Settings& settings = {}, const std::string& technique_name = "izb") {
  return render_frame(scene, camera, light, width_px, height_px, settings, *make_technique(technique_name));
}

/// The mask of all pairs of triangle and pixel: no grid, no raster, the same test function.
inline std::vector<uint32_t> brute_force_mask(const Frame& frame) {
  std::vector<uint32_t> mask(frame.mask.size(), 0u);
  for (size_t i = 0; i < mask.size(); ++i) {
    if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
    const float t = frame.gbuffer.eye_distance[i];
    for (size_t k = 0; k < frame.triangles_vs.size() / 3 && mask[i] == 0u; ++k) {
      const glm::vec3* v = &frame.triangles_vs[3 * k];
      const glm::vec3& p = frame.receivers.points_vs[i];
      if (k == frame.receivers.own_triangle[i] ||
          !shared::occludes(frame.inputs.camera, frame.inputs.light, v[0], v[1], v[2], p, t))
        continue;
      if (frame.masks.masked(k) &&
          !frame.masks.is_there(
              k, shared::texel_of_weights(frame.masks.corners(k, frame.masks.uvs_of[k]),
                                          shared::light_weights(frame.inputs.light, p, v[0], v[1], v[2]))))
        continue;
      mask[i] = 0xffffffffu;
    }
  }
  return mask;
}

/// Those of a masked triangle's bits whose samples hit what is there.
inline uint32_t uncut_words(const Frame& frame, size_t k, const glm::ivec2& px, const glm::vec4& quad, uint32_t bits) {
  const FrameInputs& in = frame.inputs;
  glm::vec3 a = frame.triangles_vs[3 * k], b = frame.triangles_vs[3 * k + 1], c = frame.triangles_vs[3 * k + 2];
  std::array<glm::vec2, 3> uv = frame.masks.uvs_of[k];
  shared::order_with_uvs(a, b, c, uv[0], uv[1], uv[2]);
  const shared::HitPlanes hits =
      shared::hit_planes(shared::quad_planes(in.camera, in.light, a, b, c, px, quad), frame.masks.corners(k, uv));
  uint32_t kept = 0;
  for (int s = 0; s < 32; ++s)
    if ((bits >> s & 1u) != 0 &&
        frame.masks.is_there(k, shared::texel_of_sample(hits, in.samples.offsets_px[size_t(s)])))
      kept |= 1u << s;
  return kept;
}

inline std::vector<uint32_t> brute_force_words(const Frame& frame) {
  const FrameInputs& in = frame.inputs;
  std::vector<uint32_t> mask(frame.mask.size(), 0u);
  for (size_t i = 0; i < mask.size(); ++i) {
    if (frame.receivers.classes[i] != reference::PixelClass::receiver) continue;
    const glm::ivec2 px(frame.gbuffer.center_px(i));
    for (size_t k = 0; k < frame.triangles_vs.size() / 3; ++k) {
      if (k == frame.receivers.spared(i)) continue;
      const glm::vec3* v = &frame.triangles_vs[3 * k];
      const shared::QuadPlanes planes =
          shared::quad_planes(in.camera, in.light, v[0], v[1], v[2], px, frame.gbuffer.micro_quad[i]);
      uint32_t bits = 0;
      for (int s = 0; s < 32; ++s)
        if (shared::occluded_sample(planes, in.samples.offsets_px[size_t(s)])) bits |= 1u << s;
      if (bits != 0u && frame.masks.masked(k)) bits = uncut_words(frame, k, px, frame.gbuffer.micro_quad[i], bits);
      mask[i] |= bits;
    }
  }
  return mask;
}

inline size_t different(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  size_t n = 0;
  for (size_t i = 0; i < a.size(); ++i) n += a[i] != b[i];
  return n;
}

inline size_t shadowed(const Frame& frame) {
  return static_cast<size_t>(std::count(frame.mask.begin(), frame.mask.end(), 0xffffffffu));
}

inline size_t receivers(const Frame& frame) {
  return static_cast<size_t>(
      std::count(frame.receivers.classes.begin(), frame.receivers.classes.end(), reference::PixelClass::receiver));
}

/// Settles the mask against rays; expects no unexplained bit.
inline reference::Settled expect_explained(const Frame& frame) {
  const reference::Triangles& triangles = frame.triangles;
  const reference::RayTracer tracer(triangles);
  const reference::MaskTrace traced = tracer.trace_mask(frame.light, frame.receivers);
  reference::Settled settled = reference::settle(triangles, frame.light, frame.receivers, frame.mask, traced.mask);
  EXPECT_EQ(settled.unexplained, 0u);
  return settled;
}

inline Light spot(const glm::dvec3& position_ws, const glm::dvec3& target_ws, double half_angle_deg) {
  Light light;
  light.type = LightType::spot;
  light.position_ws = position_ws;
  light.direction_ws = glm::normalize(target_ws - position_ws);
  light.outer_cone_rad = glm::radians(half_angle_deg);
  light.inner_cone_rad = 0.9 * light.outer_cone_rad;
  return light;
}

inline Light point_light(const glm::dvec3& position_ws) {
  Light light;
  light.type = LightType::point;
  light.position_ws = position_ws;
  return light;
}

}  // namespace izb::test

// SPDX-License-Identifier: MIT
#include "shadow/ray_traced/receivers.h"

#include "reference/exact.h"
#include "reference/parallel.h"

namespace izb {
namespace {

/// On all cores.
template <typename Body>
void for_each_pixel(size_t count, Body&& body) {
  constexpr size_t pixels_per_chunk = 4096;
  reference::parallel_for(count, pixels_per_chunk, 0, [&](size_t begin, size_t end, unsigned) {
    for (size_t i = begin; i < end; ++i) body(i);
  });
}

/// The micro-quads' centres, the samples' offsets, and the tangent planes of the pixels' own triangles in double.
void add_samples(reference::Receivers& receivers, const GBufferImage& image, const FrameInputs& in) {
  receivers.offsets_px.assign(in.samples.offsets_px.begin(), in.samples.offsets_px.end());
  receivers.camera = {glm::dvec2(in.camera.pixel_ray), shared::is_perspective(in.camera)};
  const std::vector<glm::vec3>& vertices = in.triangles_vs();
  receivers.centers_vs.resize(receivers.count());
  receivers.slopes.assign(receivers.count(), glm::dvec2(0.0));
  for_each_pixel(receivers.count(), [&](size_t i) {
    receivers.centers_vs[i] = quad_center_vs(image, in.camera, i);
    if (receivers.own_triangle[i] == reference::no_triangle) return;
    const glm::vec3* v = &vertices[3 * size_t(receivers.own_triangle[i])];
    receivers.slopes[i] =
        reference::tangent_slopes(receivers.points_vs[i], reference::normal({v[0], v[1], v[2]}), receivers.camera);
  });
}

}  // namespace

reference::Receivers make_receivers(const GBufferImage& image, const FrameInputs& in) {
  constexpr float band_px = 1.0f / 64.0f;
  reference::Receivers receivers;
  const size_t count = image.size();
  receivers.width_px = image.width_px;  // packets of rays cover tiles of pixels
  receivers.points_vs.resize(count);
  receivers.own_triangle.assign(count, reference::no_triangle);
  receivers.classes.resize(count);
  receivers.band.resize(count);
  for_each_pixel(count, [&](size_t i) {
    receivers.points_vs[i] = receiver_point_vs(image, in.camera, i);
    receivers.classes[i] = static_cast<reference::PixelClass>(pixel_class(image, in.camera, in.light, i));
    receivers.band[i] = band_px * shared::pixel_width(in.camera, image.eye_distance[i]);
    if (image.id[i].x != 0) receivers.own_triangle[i] = (*in.first_triangle)[image.id[i].x - 1] + image.id[i].y;
  });
  // The only sample of a pattern of one is the receiver point itself.
  if (in.samples.count() > 1) add_samples(receivers, image, in);
  return receivers;
}

reference::Triangles make_triangles(const FrameInputs& in) {
  reference::Triangles triangles{in.triangles_vs()};
  if (!in.masked_casters || !in.scene || !in.draw_list) return triangles;
  auto cutouts = std::make_shared<reference::Cutouts>(*in.scene);
  for (const DrawPart& part : in.draw_list->parts) {
    const Mesh& mesh = in.scene->meshes[in.scene->instances[part.instance].mesh];
    if (in.scene->materials[mesh.material].alpha_mode != AlphaMode::mask) {
      cutouts->add_opaque(part.triangle_count);
      continue;
    }
    const size_t first = 3 * size_t(part.mesh_triangle), end = first + 3 * size_t(part.triangle_count);
    for (size_t i = first; i < end; i += 3) {
      if (mesh.uvs.empty()) {
        cutouts->add(mesh.material, nullptr);
        continue;
      }
      const glm::vec2 uvs[3] = {mesh.uvs[mesh.indices[i]], mesh.uvs[mesh.indices[i + 1]],
                                mesh.uvs[mesh.indices[i + 2]]};
      cutouts->add(mesh.material, uvs);
    }
  }
  triangles.cutouts = std::move(cutouts);
  return triangles;
}

reference::LightPoint make_light_point(const shared::LightFrame& light) {
  const bool positional = shared::is_positional(light);
  return {positional ? glm::vec3(light.origin) : glm::vec3(light.to_light), positional, light.axis_x.w};
}

}  // namespace izb

// SPDX-License-Identifier: MIT
#include "view/take_snapshot.h"

#include "image/srgb.h"
#include "shadow/izb/izb.h"

namespace izb {
namespace {

/// Alpha tells whether there is a shading normal: see GBuffer.
void read_surfaces(Snapshot& s, const GBuffer& gbuffer, unsigned needs) {
  const auto top_first = [&](auto rows) { return flip_rows(std::move(rows), s.width_px, s.height_px); };
  const std::vector<uint8_t> albedo = gbuffer.albedo.read<uint8_t>(GL_RGBA, GL_UNSIGNED_BYTE, 4);
  if ((needs & Need::albedo) != 0) {
    s.albedo.resize(s.size());
    for (size_t i = 0; i < s.size(); ++i)
      for (int k = 0; k < 3; ++k) s.albedo[i][k] = srgb_to_linear(float(albedo[4 * i + size_t(k)]) / 255.0f);
    s.albedo = top_first(std::move(s.albedo));
  }
  if ((needs & Need::shading_normal) != 0) {
    const std::vector<float> encoded = gbuffer.shading_normal.read<float>(GL_RG, GL_FLOAT, 2);
    s.shading_normal.assign(s.size(), glm::vec3(0.0f));
    for (size_t i = 0; i < s.size(); ++i)
      if (albedo[4 * i + 3] > 191)
        s.shading_normal[i] =
            shared::octahedral_decode(glm::vec2(2.0f * encoded[2 * i] - 1.0f, 2.0f * encoded[2 * i + 1] - 1.0f));
    s.shading_normal = top_first(std::move(s.shading_normal));
  }
}

}  // namespace

Snapshot take_snapshot(Renderer& renderer, Technique& technique, const Camera& camera, size_t light, unsigned needs) {
  const FrameInputs& in = renderer.inputs(light);
  Snapshot s;
  s.width_px = in.width_px;
  s.height_px = in.height_px;
  s.camera = in.camera;
  s.light = in.light;
  s.camera_ws = camera;
  s.samples = in.samples;
  s.first_triangle = *in.first_triangle;
  s.gbuffer = read_gbuffer(*in.gbuffer);
  if ((needs & (Need::albedo | Need::shading_normal)) != 0) read_surfaces(s, *in.gbuffer, needs);
  if ((needs & Need::mask) != 0) s.mask = renderer.read_mask(light);

  if ((needs & Need::tests) != 0)
    if (std::vector<float> tests = renderer.tests_a_pixel(light); !tests.empty())
      s.tests = flip_rows(std::move(tests), s.width_px, s.height_px);
  if ((needs & Need::fragments) != 0) s.fragments = renderer.fragments_a_texel(light);

  constexpr unsigned of_lists = Need::list_length | Need::built | Need::furthest | Need::left;
  const bool lists = (needs & of_lists) != 0;
  // Also puts back what the light's own frame had bound and built, where another light's came after it.
  if (lists || renderer.light_count() > 1) {
    std::vector<float> lengths = renderer.list_lengths(light);
    if ((needs & Need::list_length) != 0 && !lengths.empty())
      s.list_length = flip_rows(std::move(lengths), s.width_px, s.height_px);
  }
  if ((needs & Need::windows) != 0) {
    const int layers = static_cast<int>(in.light.grid.y * in.light.grid.z);
    for (int layer = 0; layer < layers; ++layer) s.windows.push_back(renderer.bounds().read_window(layer));
    s.cascades = renderer.bounds().read_cascades();
  }
  const Izb* izb = dynamic_cast<Izb*>(&technique);
  if (!izb || !lists) return s;
  if ((needs & (Need::built | Need::furthest)) != 0) s.built = izb->internals();
  if ((needs & Need::left) != 0) {
    Visibility scratch{gpu::Texture("mask of a snapshot", GL_R32UI, s.width_px, s.height_px)};
    gpu::StageTimers untimed(false);
    technique.render(in, scratch, untimed);
    s.left = izb->internals();
  }
  return s;
}

}  // namespace izb

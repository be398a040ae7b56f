// SPDX-License-Identifier: MIT
// What large scenes need, on small ones: meshes drawn in parts, and buffers bound in windows. No mask may change.
#include "base/error.h"
#include "gl/frame_fixture.h"

namespace izb::test {
namespace {

constexpr int width_px = 96, height_px = 64;
const Camera camera = look_at({4.0, 5.0, 7.0}, {0.0, 0.6, 0.0}, glm::radians(50.0));

/// Of several meshes, one placed three times, all of more triangles than fit into a small part or window.
Scene several() {
  Scene scene = tangle(150, 700);
  add_soup(scene, floor_of(1.0f, 9), glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 1.0, 0.3)));
  for (const double x : {-1.0, 1.5})
    scene.instances.push_back(
        {2, glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 1.4, 0.2)), x, glm::dvec3(1.0, 0.2, 0.0))});
  return scene;
}

Frame render(const Scene& scene, const gpu::Capabilities& driver, uint32_t part_triangles, const Settings& settings) {
  const auto technique = make_technique("izb");
  set_options(*technique, settings);
  Renderer renderer(scene, driver, part_triangles);
  renderer.prepare(*technique, width_px, height_px, {sun(130, 35)});
  return render_frame(renderer, *technique, camera, sun(130, 35));
}

const Settings all_settings[] = {{{"grid", "256"}, {"pairs", "64"}},
                                 {{"grid", "256"}, {"pairs", "4096"}},
                                 {{"grid", "256"}, {"pairs", "4096"}, {"spp", "32"}, {"coverage", "exact"}}};

TEST(LargeScene, DrawnInPartsItHasTheSameMask) {
  const Scene scene = several();
  for (const Settings& settings : all_settings) {
    const Frame whole = render(scene, capabilities(), largest_part_triangles, settings);
    ASSERT_GT(shadowed(whole), 100u);
    for (const uint32_t part_triangles : {100u, 7u, 1u}) {
      const Frame parts = render(scene, capabilities(), part_triangles, settings);
      EXPECT_EQ(different(parts.mask, whole.mask), 0u) << part_triangles;
      EXPECT_EQ(parts.gbuffer.eye_distance, whole.gbuffer.eye_distance) << part_triangles;
      expect_explained(parts);
      // The frame's numbering: each pixel's own triangle is the same one.
      for (size_t i = 0; i < parts.mask.size(); ++i) {
        const uint32_t own = parts.receivers.own_triangle[i], in_whole = whole.receivers.own_triangle[i];
        for (size_t corner = 0; own != reference::no_triangle && corner < 3; ++corner)
          ASSERT_EQ(parts.triangles_vs[3 * size_t(own) + corner], whole.triangles_vs[3 * size_t(in_whole) + corner])
              << part_triangles;
      }
    }
  }
}

TEST(LargeScene, PartsCoverTheMeshes) {
  const Scene scene = several();
  for (const uint32_t part_triangles : {1u, 7u, 100u, 1000000u}) {
    const DrawList list = make_draw_list(scene, part_triangles);
    uint32_t next = 0, drawn = 0, grouped = 0;
    std::vector<uint32_t> of_instance(scene.instances.size(), 0);
    for (size_t p = 0; p < list.parts.size(); ++p) {
      EXPECT_EQ(list.parts[p].first_triangle, next);
      EXPECT_EQ(list.first_triangle[p], next);
      EXPECT_LE(list.parts[p].triangle_count, part_triangles);
      EXPECT_EQ(list.parts[p].mesh_triangle, of_instance[list.parts[p].instance]);
      of_instance[list.parts[p].instance] += list.parts[p].triangle_count;
      next += list.parts[p].triangle_count;
    }
    EXPECT_EQ(next, scene.triangle_count());
    for (const DrawCommand& command : list.commands) {
      EXPECT_EQ(list.parts[command.base_instance].first_triangle, drawn);
      drawn += command.index_count / 3 * command.instance_count;
    }
    EXPECT_EQ(drawn, next);
    for (const DrawGroup& group : list.groups) grouped += group.command_count;
    EXPECT_EQ(grouped, list.commands.size());
  }
}

TEST(LargeScene, BoundInWindowsItHasTheSameMask) {
  const Scene scene = several();
  for (const Settings& settings : all_settings) {
    if (settings[1].second == "4096" && settings.size() == 2) continue;  // its pairs need a large block themselves
    Settings few_pairs = settings;
    few_pairs[1].second = "64";
    const Frame whole = render(scene, capabilities(), largest_part_triangles, few_pairs);
    gpu::Capabilities small = capabilities();
    for (const int64_t limit : {7000, 10000}) {
      small.max_storage_block_bytes = limit;
      const DrawList list = make_draw_list(scene);
      const GeometryWindows windows(list.vertex_count * sizeof(glm::vec3), list.index_count * sizeof(uint32_t), small);
      EXPECT_GE(windows.positions, 3);
      EXPECT_GE(windows.indices, 2);
      const Frame parts = render(scene, small, largest_part_triangles, few_pairs);
      EXPECT_EQ(different(parts.mask, whole.mask), 0u) << limit;
      EXPECT_EQ(parts.gbuffer.eye_distance, whole.gbuffer.eye_distance) << limit;
    }
  }
}

TEST(LargeScene, MoreWindowsThanAShaderHasAreRefused) {
  gpu::Capabilities small = capabilities();
  small.max_storage_block_bytes = 2048;
  try {
    Renderer renderer(several(), small);
    ADD_FAILURE() << "not refused";
  } catch (const izb::Error& e) {
    EXPECT_NE(std::string(e.what()).find("storage blocks"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace izb::test

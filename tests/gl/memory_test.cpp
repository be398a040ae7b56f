// SPDX-License-Identifier: MIT
// What is computed beforehand is what is taken, and what would not fit is refused.
#include "gpu/memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "base/error.h"
#include "gl/frame_fixture.h"

namespace {

using namespace izb;
using namespace izb::test;

const int width_px = 67, height_px = 35;
const std::vector<Light> suns{sun(30.0, 50.0)};

struct PretendedMemory {
  explicit PretendedMemory(uint64_t bytes) { setenv("IZB_MEMORY_BYTES", std::to_string(bytes).c_str(), 1); }
  ~PretendedMemory() { unsetenv("IZB_MEMORY_BYTES"); }
};

template <typename Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void set(Technique& technique, const Settings& settings) {
  const OptionSet options = technique.options();
  for (const auto& [name, value] : settings)
    for (const Option& option : options.options())
      if (option.name == name) option.set(value);
}

std::map<std::string, uint64_t> by_part(const gpu::Plan& plan) {
  std::map<std::string, uint64_t> parts;
  for (const gpu::Planned& p : plan) parts[p.part] += p.bytes;
  return parts;
}

Camera above() {
  return look_at({0.0, 6.0, 7.0}, {0.0, 0.0, 0.0}, glm::radians(50.0));
}

/// A scene with a texture whose levels are not all powers of two.
Scene textured() {
  Scene scene = tangle(1, 20);
  Texture texture;
  texture.name = "odd";
  texture.width_px = 13;
  texture.height_px = 5;
  texture.rgba.assign(size_t(13) * 5 * 4, 128);
  scene.textures.push_back(texture);
  scene.materials[0].base_color_texture = 0;
  return scene;
}

TEST(Memory, OfAlphaMapsIsAByteATexelOfMaskedMaterials) {
  Scene scene = textured();
  Texture& texture = scene.textures[0];
  texture.width_px = 130;
  texture.rgba.assign(size_t(130) * 5 * 4, 128);
  const auto scene_parts = [&] { return by_part(SceneBuffers::memory_needed(scene, make_draw_list(scene))); };
  EXPECT_FALSE(scene_parts().contains("alpha maps"));
  scene.materials[0].alpha_mode = AlphaMode::mask;
  EXPECT_EQ(scene_parts().at("alpha maps"), 1u + 130u * 5u);
  EXPECT_EQ(SceneBuffers(scene, make_draw_list(scene), capabilities()).bytes(),
            gpu::bytes_of(SceneBuffers::memory_needed(scene, make_draw_list(scene))));
  gpu::Capabilities little = capabilities();
  little.max_buffer_texels = 650;
  const std::string sentence = error_of([&] { SceneBuffers(scene, make_draw_list(scene), little); });
  EXPECT_NE(sentence.find("'alpha maps'"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("buffer textures stop at 650 texels"), std::string::npos) << sentence;
}

TEST(Memory, IsWhatWasComputedBefore) {
  const Scene scene = textured();
  Renderer renderer(scene, capabilities());
  std::vector<Settings> all{{},
                            {{"zcull", "off"}},
                            {{"zcull-pyramid", "off"}},
                            {{"pairs", "0"}},
                            {{"cascades", "3"}},
                            {{"raster", "compute"}},
                            {{"occluders", "on"}},
                            {{"occluders", "on"}, {"zcull", "off"}}};
  for (const char* insertion : {"approximate", "nv", "samples", "exact"})
    for (const char* cascades : {"1", "4", "8"})
      all.push_back({{"spp", "32"}, {"insertion", insertion}, {"cascades", cascades}, {"nodes", "5"}, {"lut", "32"}});
  all.push_back({{"spp", "32"}, {"coverage", "exact"}});
  const std::vector<Light> sun_and_lamp{sun(30.0, 50.0), point_light({0.0, 2.0, 0.0})};
  for (size_t i = 0; i < all.size(); ++i) {
    const Settings& settings = all[i];
    SCOPED_TRACE(testing::PrintToString(settings));
    const std::vector<Light>& lights = i % 3 == 0 ? sun_and_lamp : suns;
    const std::unique_ptr<Technique> technique = make_technique("izb");
    set(*technique, with({{"grid", "130"}}, settings));
    const int faces = lights.size() > 1 ? shared::cube_faces : 1;
    const std::map<std::string, uint64_t> needed = by_part(technique->memory_needed({width_px, height_px, faces}));
    const gpu::Plans plans = renderer.memory_needed(*technique, width_px, height_px, lights);
    renderer.prepare(*technique, width_px, height_px, lights);
    for (const auto& [part, bytes] : technique->memory())
      EXPECT_EQ(needed.contains(part) ? needed.at(part) : 0, bytes) << part;
    const Counts measured = renderer.memory();
    ASSERT_EQ(plans.size(), measured.size());
    for (size_t group = 0; group < plans.size(); ++group) {
      EXPECT_EQ(plans[group].first, measured[group].first);
      EXPECT_EQ(gpu::bytes_of(plans[group].second), measured[group].second) << plans[group].first;
    }
  }
}

TEST(Memory, OfTheRayTracerIsTheFramesAlone) {
  const Scene scene = tangle(1, 5);
  Renderer renderer(scene, capabilities());
  const std::unique_ptr<Technique> technique = make_technique("ray_traced");
  if (!technique->missing(capabilities()).empty()) GTEST_SKIP() << "this build has no Embree";
  const gpu::Plans plans = renderer.memory_needed(*technique, width_px, height_px, suns);
  renderer.prepare(*technique, width_px, height_px, suns);
  EXPECT_EQ(renderer.memory()[0].second, uint64_t(4 * width_px * height_px));
  EXPECT_EQ(gpu::bytes_of(plans[0].second), renderer.memory()[0].second);
}

TEST(Memory, ThatIsShortIsRefusedBeforeItIsTaken) {
  const Scene scene = tangle(1, 5);
  Renderer renderer(scene, capabilities());
  const std::unique_ptr<Technique> technique = make_technique("izb");
  uint64_t sum = 0;
  for (const auto& [group, plan] : renderer.memory_needed(*technique, width_px, height_px, suns))
    sum += gpu::bytes_of(plan);
  {
    const PretendedMemory little(sum - 1);
    const std::string sentence = error_of([&] { renderer.prepare(*technique, width_px, height_px, suns); });
    EXPECT_NE(sentence.find("not enough memory"), std::string::npos) << sentence;
    EXPECT_LT(sentence.find("--grid"), sentence.find("--size")) << sentence;  // what helps most comes first
    for (const auto& [part, bytes] : technique->memory()) EXPECT_EQ(bytes, 0u) << part;
  }
  const PretendedMemory enough(sum);
  renderer.prepare(*technique, width_px, height_px, suns);
}

TEST(Memory, OfASceneThatIsShortIsRefusedBeforeTheUpload) {
  const Scene scene = tangle(1, 500);
  const PretendedMemory little(1000);
  const std::string sentence = error_of([&] { const Renderer renderer(scene, capabilities()); });
  EXPECT_NE(sentence.find("scene 'test'"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("smaller scene"), std::string::npos) << sentence;
}

TEST(Memory, OfExactInsertionIsRefusedOnceItsNodesAreCounted) {
  const Scene scene = tangle(1, 20);
  Renderer renderer(scene, capabilities());
  const std::unique_ptr<Technique> technique = make_technique("izb");
  set(*technique, {{"spp", "32"}, {"insertion", "exact"}, {"grid", "256"}, {"grid-density", "0"}});
  gpu::StageTimers timers(true);
  renderer.prepare(*technique, width_px, height_px, suns);
  {
    const PretendedMemory little(200'000);  // a row of the pool is 131 kB
    const std::string sentence = error_of([&] { renderer.render(above(), suns, timers); });
    EXPECT_NE(sentence.find("exact insertion"), std::string::npos) << sentence;
  }
  gpu::StageTimers fresh(true);
  renderer.render(above(), suns, fresh);
  EXPECT_GT(renderer.memory()[0].second,
            gpu::bytes_of(renderer.memory_needed(*technique, width_px, height_px, suns)[0].second));
}

TEST(Memory, ObjectsBeyondTheDriversLimitsAreRefusedByName) {
  gpu::Capabilities c = capabilities();
  const gpu::Room unknown;
  const auto sentence = [&](const gpu::Planned& p) {
    return error_of([&] { gpu::expect_room({{"izb", {p}}}, unknown, c); });
  };
  using Kind = gpu::Planned::Kind;
  const auto buffer = [](Kind kind, uint64_t bytes) { return gpu::planned_buffer("pairs", kind, bytes, {"--pairs"}); };
  const auto storage = static_cast<uint64_t>(c.max_storage_block_bytes);
  EXPECT_EQ(sentence(buffer(Kind::storage_buffer, storage)), "");
  EXPECT_NE(sentence(buffer(Kind::storage_buffer, storage + 1)).find("reduce --pairs"), std::string::npos);
  const auto texels = static_cast<uint64_t>(c.max_buffer_texels);
  EXPECT_EQ(sentence(buffer(Kind::buffer_texture, 4 * texels)), "");
  EXPECT_NE(sentence(buffer(Kind::buffer_texture, 4 * texels + 4)).find("texels"), std::string::npos);

  const auto texture = [&](int width, int layers) {
    return gpu::planned_texture("heads", GL_R32UI, width, 16, {"--grid", "--cascades"}, layers);
  };
  EXPECT_EQ(sentence(texture(16, 8)), "");
  EXPECT_NE(sentence(texture(static_cast<int>(c.max_texture_size) + 1, 1)).find("a side"), std::string::npos);
  EXPECT_NE(sentence(texture(16, static_cast<int>(c.max_texture_layers) + 1)).find("layers"), std::string::npos);
  // Within every limit that has a name, yet more than llvmpipe takes for one object. NVIDIA's proxy takes it.
  if (!c.software) return;
  const int side = static_cast<int>(c.max_texture_size);
  const std::string vast = sentence(
      gpu::planned_texture("nodes", GL_RGBA32F, side, side, {"--grid"}, static_cast<int>(c.max_texture_layers)));
  EXPECT_NE(vast.find("'nodes'"), std::string::npos) << vast;
}

}  // namespace

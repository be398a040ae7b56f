// SPDX-License-Identifier: MIT
// Renderers that go on: prepared anew for other sizes and options, and several over one scene's buffers. Their masks
// are those of renderers made for one frame.
#include <map>

#include "gl/frame_fixture.h"
#include "gl/masked_scene.h"

namespace izb::test {
namespace {

const Camera camera = look_at({4.0, 5.0, 7.0}, {0, 0.6, 0}, glm::radians(50.0));
const std::vector<Light> suns{sun(130, 35)};
const Settings many{{"spp", "32"}, {"grid", "128"}};

struct Reused {
  std::unique_ptr<Technique> technique;
  Renderer renderer;

  Reused(const Scene& scene, const Settings& settings, const std::string& name = "izb")
      : technique(make_technique(name)), renderer(scene, capabilities()) {
    set_options(*technique, settings);
  }
  Reused(const Scene& scene, const Settings& settings, const std::string& name, std::shared_ptr<SceneBuffers> buffers)
      : technique(make_technique(name)), renderer(scene, capabilities(), std::move(buffers)) {
    set_options(*technique, settings);
  }

  std::vector<uint32_t> mask(const Camera& its_camera = camera, const std::vector<Light>& lights = suns) {
    gpu::StageTimers timers(true);
    renderer.render(its_camera, lights, timers);
    return renderer.read_mask(lights.size() - 1);
  }
  std::vector<uint32_t> mask_of(int width_px, int height_px, const std::vector<Light>& lights = suns) {
    renderer.prepare(*technique, width_px, height_px, lights);
    return mask(camera, lights);
  }
  void set(const std::string& option, const std::string& value) {
    const OptionSet options = technique->options();
    for (const Option& each : options.options())
      if (each.name == option) each.set(value);
  }
};

std::vector<uint32_t> fresh_mask(const Scene& scene, const Settings& settings, int width_px, int height_px,
                                 const std::vector<Light>& lights = suns) {
  return Reused(scene, settings).mask_of(width_px, height_px, lights);
}

TEST(Reuse, SizesAndLightsChangeWithoutCompiling) {
  const Scene scene = masked_tangle(3);
  const std::vector<Light> two{sun(130, 35), sun(20, 50)};
  for (const Settings& settings : {many, Settings{{"spp", "1"}, {"grid", "128"}},
                                   Settings{{"spp", "32"}, {"grid", "64"}, {"insertion", "exact"}}}) {
    Reused reused(scene, settings);
    const std::vector<uint32_t> big = reused.mask_of(64, 48);
    const uint64_t programs = gpu::programs_made();
    const std::vector<uint32_t> small = reused.mask_of(24, 30);
    const std::vector<uint32_t> second = reused.mask_of(24, 30, two);
    EXPECT_EQ(reused.mask_of(64, 48), big);
    EXPECT_EQ(gpu::programs_made(), programs) << settings[0].second;
    EXPECT_EQ(big, fresh_mask(scene, settings, 64, 48));
    EXPECT_EQ(small, fresh_mask(scene, settings, 24, 30));
    EXPECT_EQ(second, fresh_mask(scene, settings, 24, 30, two));
    EXPECT_NE(second, small);
  }
}

TEST(Reuse, OptionsCompileWhatTheyChange) {
  const Scene scene = tangle(5, 200);
  const std::pair<const char*, const char*> changes[] = {
      {"spp", "1"},          {"spp", "32"},          {"cascades", "3"},     {"zcull", "off"},
      {"cascades", "1"},     {"zcull", "on"},        {"coverage", "exact"}, {"zcull-pyramid", "off"},
      {"coverage", "lut"},   {"insertion", "exact"}, {"grid", "100"},       {"insertion", "nv"},
      {"samples", "halton"}, {"removal", "off"},     {"lut", "32"},         {"raster", "compute"},
      {"raster", "gs"},      {"occluders", "on"},    {"zcull", "off"},      {"occluders", "off"}};
  Reused reused(scene, many);
  reused.mask_of(64, 48);
  std::map<std::string, std::string> now;
  for (const auto& [option, value] : changes) {
    reused.set(option, value);
    now[option] = value;
    Settings settings = many;
    settings.insert(settings.end(), now.begin(), now.end());
    EXPECT_EQ(reused.mask_of(64, 48), fresh_mask(scene, settings, 64, 48)) << option << " " << value;
  }
  const uint64_t programs = gpu::programs_made();
  for (const auto& [option, value] : {std::pair{"grid", "64"}, {"lut", "64"}, {"nodes", "2"}, {"pairs", "10"}}) {
    reused.set(option, value);
    reused.mask_of(64, 48);
    EXPECT_EQ(gpu::programs_made(), programs) << option;
  }
  reused.set("unchanged-skip", "off");
  reused.mask_of(64, 48);
  EXPECT_GT(gpu::programs_made(), programs);
}

TEST(Reuse, ASecondPreparationForTheSameMakesNothing) {
  const Scene scene = masked_tangle(3);
  for (const char* insertion : {"approximate", "exact"}) {
    Reused reused(scene, with(many, {{"insertion", insertion}, {"grid", "1024"}, {"grid-density", "0"}}));
    const std::vector<uint32_t> mask = reused.mask_of(64, 48);
    // Names count what was made between: a driver gives those of the deleted again, or always the next.
    const auto next_names = [] {
      GLuint names[4] = {};
      glCreateTextures(GL_TEXTURE_2D, 1, &names[0]);
      glCreateBuffers(1, &names[1]);
      glCreateFramebuffers(1, &names[2]);
      names[3] = glCreateProgram();
      const std::vector<GLuint> all(names, names + 4);
      glDeleteTextures(1, &names[0]);
      glDeleteBuffers(1, &names[1]);
      glDeleteFramebuffers(1, &names[2]);
      glDeleteProgram(names[3]);
      return all;
    };
    const GLuint mask_name = reused.renderer.mask().name(), picture_name = reused.renderer.picture().name();
    const Counts memory = reused.renderer.memory();
    const std::vector<GLuint> first = next_names(), second = next_names();
    EXPECT_EQ(reused.mask_of(64, 48), mask);
    const std::vector<GLuint> third = next_names();
    for (size_t kind = 0; kind < 4; ++kind)
      EXPECT_EQ(third[kind] - second[kind], second[kind] - first[kind]) << insertion << " " << kind;
    EXPECT_EQ(reused.renderer.mask().name(), mask_name);
    EXPECT_EQ(reused.renderer.picture().name(), picture_name);
    EXPECT_EQ(reused.renderer.memory(), memory);
  }
}

TEST(Reuse, MemoryIsThatOfAFreshRenderer) {
  const Scene scene = tangle(5, 50);
  Reused reused(scene, many);
  for (const auto& [option, value] : {std::pair{"spp", "1"},
                                      {"zcull", "off"},
                                      {"spp", "32"},
                                      {"insertion", "exact"},
                                      {"zcull", "on"},
                                      {"cascades", "2"},
                                      {"insertion", "nv"}}) {
    reused.set(option, value);
    for (const glm::ivec2 size : {glm::ivec2(64, 48), glm::ivec2(16, 80)}) {
      reused.renderer.prepare(*reused.technique, size.x, size.y, suns);
      std::map<std::string, uint64_t> planned;
      for (const auto& [group, plan] : reused.renderer.memory_needed(*reused.technique, size.x, size.y, suns))
        planned[group] = gpu::bytes_of(plan);
      for (const auto& [group, bytes] : reused.renderer.memory())
        EXPECT_EQ(bytes, planned[group]) << group << " " << option << " " << value;
    }
  }
}

/// A tangle whose triangles a morph target moves.
Scene morphing(uint32_t seed) {
  Scene scene = tangle(seed, 150);
  MorphTarget target;
  Random random(seed);
  for (size_t i = 0; i < scene.meshes[1].positions.size(); ++i) target.positions.emplace_back(random.point(0.5));
  scene.meshes[1].targets.push_back(std::move(target));
  scene.instances[1].morph_weights = {0.0f};
  return scene;
}

TEST(Reuse, TwoRenderersShareTheBuffersOfAScene) {
  Scene scene = morphing(7);
  const Settings one{{"spp", "1"}, {"grid", "128"}};
  Reused a(scene, many);
  Reused b(scene, one, "izb", a.renderer.shared_scene_buffers());
  Reused rays(scene, {{"spp", "32"}}, "ray_traced", a.renderer.shared_scene_buffers());
  EXPECT_EQ(&a.renderer.scene_buffers(), &b.renderer.scene_buffers());
  const Camera other = look_at({-5.0, 4.0, 3.0}, {0, 0.4, 0}, glm::radians(60.0));
  const std::vector<Light> two{spot({2, 6, 3}, {0, 0, 0}, 40), sun(20, 50)};
  a.renderer.prepare(*a.technique, 64, 48, suns);
  b.renderer.prepare(*b.technique, 40, 30, two);
  rays.renderer.prepare(*rays.technique, 32, 24, suns);
  std::vector<uint32_t> last;
  for (int frame = 0; frame < 4; ++frame) {
    scene.instances[1].morph_weights[0] = 0.4f * static_cast<float>(frame);
    scene.instances[1].world_from_object = glm::translate(glm::dmat4(1.0), {0.2 * frame, 0, 0});
    const std::vector<uint32_t> mask_a = a.mask(), mask_b = b.mask(other, two), mask_rays = rays.mask(other);
    Reused alone_a(scene, many), alone_b(scene, one), alone_rays(scene, {{"spp", "32"}}, "ray_traced");
    alone_a.renderer.prepare(*alone_a.technique, 64, 48, suns);
    alone_b.renderer.prepare(*alone_b.technique, 40, 30, two);
    alone_rays.renderer.prepare(*alone_rays.technique, 32, 24, suns);
    EXPECT_EQ(mask_a, alone_a.mask()) << frame;
    EXPECT_EQ(mask_b, alone_b.mask(other, two)) << frame;
    EXPECT_EQ(mask_rays, alone_rays.mask(other)) << frame;
    EXPECT_NE(mask_a, last);
    last = mask_a;
    // What comes after a frame, though others have rendered since, and not of the light that was last.
    const auto steady = [](Counts counts) {  // removal depends on the order of fragments
      std::erase_if(counts, [](const auto& c) {
        return c.first == "visibility_tests" || c.first == "nodes_removed" || c.first == "masks_unchanged" ||
               c.first == "pairs_in_double";
      });
      return counts;
    };
    EXPECT_EQ(steady(a.renderer.count()), steady(alone_a.renderer.count()));
    for (const size_t light : {0, 1}) {
      EXPECT_EQ(steady(b.renderer.count(light)), steady(alone_b.renderer.count(light)));
      EXPECT_EQ(b.renderer.list_lengths(light), alone_b.renderer.list_lengths(light));
      EXPECT_EQ(b.renderer.fragments_a_texel(light), alone_b.renderer.fragments_a_texel(light));
    }
    EXPECT_EQ(a.renderer.read_mask(), mask_a);
    EXPECT_EQ(b.renderer.read_mask(1), mask_b);
  }
}

TEST(Reuse, ASharedSceneIsCountedByEachThatNeedsIt) {
  const Scene scene = tangle(5, 50);
  Reused a(scene, many);
  const std::shared_ptr<SceneBuffers> buffers = a.renderer.shared_scene_buffers();
  Reused b(scene, many, "izb", buffers);
  for (Reused* each : {&a, &b}) each->renderer.prepare(*each->technique, 16, 12, suns);
  EXPECT_EQ(a.renderer.memory(), b.renderer.memory());
  EXPECT_EQ(b.renderer.memory().back(), (std::pair<std::string, uint64_t>("scene", buffers->bytes())));
  EXPECT_EQ(buffers.use_count(), 3);
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// Whatever is wrong with the input or the output: one sentence that names it, the exit code, and nothing left
// behind.
#include <gtest/gtest.h>

#include <limits>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "cpu/full_device.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

struct BadInput : testing::Test {
  const TemporaryFolder folder;
  const fs::path output = folder / "output";
  BadInput() {
    fs::create_directory(output);
    // The program may run with fewer rights than this test.
    fs::permissions(output.parent_path(), fs::perms::all);
    fs::permissions(output, fs::perms::all);
  }

  fs::path good() const { return write_file(folder / "good.glb", roof_over_floor().glb()); }

  Outcome render(const fs::path& scene, std::vector<std::string> more = {}, const RunOptions& options = {}) const {
    std::vector<std::string> words{"render",    scene,
                                   "-o",        output / "frame.exr",
                                   "--preview", output / "frame.png",
                                   "--json",    output / "frame.json",
                                   "--size",    "32x18"};
    words.insert(words.end(), more.begin(), more.end());
    return izb::test::izb(words, options);
  }

  /// One line on stderr that names the file and the cause; nothing else anywhere.
  void expect_refused(const Outcome& outcome, const std::string& file, const std::string& cause, int code = 1) const {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const std::vector<std::string> lines = outcome.error_lines();
    ASSERT_EQ(lines.size(), 1u) << outcome.err;
    EXPECT_TRUE(lines[0].starts_with("izb: ")) << lines[0];
    EXPECT_NE(lines[0].find(file), std::string::npos) << "no '" << file << "' in: " << lines[0];
    EXPECT_NE(lines[0].find(cause), std::string::npos) << "no '" << cause << "' in: " << lines[0];
    EXPECT_EQ(names_in(output), std::vector<std::string>{});
  }

  void expect_scene_refused(const std::string& name, const std::string& bytes, const std::string& cause) const {
    const fs::path scene = write_file(folder / name, bytes);
    expect_refused(render(scene), name, cause);
    // The other commands read scenes by the same door.
    expect_refused(izb::test::izb({"validate", scene, "--size", "32x18"}), name, cause);
  }
};

// ---- the scene
// ------------------------------------------------------------------------------------------------------

TEST_F(BadInput, MissingFile) {
  expect_refused(render(folder / "absent.glb"), "absent.glb", "no such file");
}

TEST_F(BadInput, Directory) {
  expect_refused(render(output), "output", "directory");
}

TEST_F(BadInput, UnreadableFile) {
  const fs::path scene = good();
  fs::permissions(scene, fs::perms::none);
  const RunOptions nobody{{}, true};
  if (izb::test::izb({"--version"}, nobody).code != 0) GTEST_SKIP() << "another user may not run this build";
  expect_refused(render(scene, {}, nobody), "good.glb", "Permission denied");
}

TEST_F(BadInput, EmptyFile) {
  expect_scene_refused("empty.glb", "", "empty");
  expect_scene_refused("empty.gltf", "", "empty");
}

TEST_F(BadInput, RandomBytes) {
  std::string bytes;
  uint32_t state = 1;
  for (int i = 0; i < 5000; ++i) bytes += char((state = state * 1664525u + 1013904223u) >> 24);
  expect_scene_refused("random.glb", bytes, "");
  expect_scene_refused("random.gltf", bytes, "");
}

TEST_F(BadInput, TruncatedGlb) {
  const std::string bytes = roof_over_floor().glb();
  for (const size_t kept : {size_t(3), size_t(11), size_t(19), size_t(200), bytes.size() - 1})
    expect_scene_refused("cut.glb", bytes.substr(0, kept), "");
}

TEST_F(BadInput, JsonThatIsNotGltf) {
  expect_scene_refused("list.gltf", "[1, 2, 3]", "glTF");
  expect_scene_refused("object.gltf", R"({"name": "something else"})", "");
  expect_scene_refused("number.gltf", "17", "glTF");
}

TEST_F(BadInput, BufferTooShort) {
  GltfWriter gltf = one_triangle();
  gltf.root["accessors"][0]["count"] = 4;
  expect_scene_refused("short.glb", gltf.glb(), "");
  gltf = one_triangle();
  gltf.root["buffers"] = {{{"byteLength", 1000000}}};
  expect_scene_refused("shorter.glb", gltf.glb(), "");
}

TEST_F(BadInput, IndexOutOfRange) {
  GltfWriter gltf;
  const int positions = gltf.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int indices = gltf.add_array(std::vector<uint16_t>{0, 1, 3}, type_uint16, "SCALAR", 1);
  gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  expect_scene_refused("index.glb", gltf.glb(), "index");
}

TEST_F(BadInput, PositionsThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    GltfWriter gltf;
    const int positions = gltf.add_positions({0, 0, 0, 1, bad, 0, 0, 1, 0});
    gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}})}});
    expect_scene_refused("bad_position.glb", gltf.glb(), "finite");
  }
}

TEST_F(BadInput, CoordinatesBeyondSinglePrecision) {
  GltfWriter gltf = roof_over_floor();
  gltf.root["nodes"][0]["scale"] = {1e16, 1, 1};
  expect_scene_refused("huge.glb", gltf.glb(), "5e+16");
}

TEST_F(BadInput, CyclicNodes) {
  GltfWriter gltf = one_triangle();
  gltf.append("nodes", {{"children", {2}}});
  gltf.append("nodes", {{"children", {1}}});
  gltf.root["scenes"][0]["nodes"] = {0, 1};
  expect_scene_refused("cycle.glb", gltf.glb(), "");
}

TEST_F(BadInput, NoTriangle) {
  for (const int mode : {0, 1, 3}) {  // points, lines, line strip
    GltfWriter gltf = one_triangle();
    gltf.root["meshes"][0]["primitives"][0]["mode"] = mode;
    if (mode == 1) gltf.root["accessors"][1]["count"] = 2;
    expect_scene_refused("lines.glb", gltf.glb(), "no triangle");
  }
  expect_scene_refused("nothing.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})", "no triangle");
}

TEST_F(BadInput, AnExtensionThatIsRequiredAndUnknown) {
  GltfWriter gltf = one_triangle();
  gltf.root["extensionsRequired"] = {"KHR_future_geometry"};
  expect_scene_refused("draco.glb", gltf.glb(), "KHR_future_geometry");
}

TEST_F(BadInput, AbsentTextureIsAWarning) {
  GltfWriter gltf = roof_over_floor();
  gltf.root["images"] = {{{"uri", "absent.png"}}};
  gltf.root["textures"] = {{{"source", 0}}};
  gltf.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  const Outcome outcome = render(write_file(folder / "textured.glb", gltf.glb()));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.says("absent.png")) << outcome.err;
  EXPECT_EQ(names_in(output), (std::vector<std::string>{"frame.exr", "frame.json", "frame.png"}));
}

// ---- what is asked of it
// --------------------------------------------------------------------------------------------

TEST_F(BadInput, UnknownCameraOrLight) {
  expect_refused(render(good(), {"--camera", "behind"}), "behind", "above");
  expect_refused(render(good(), {"--camera", "7"}), "7", "camera");
  expect_refused(render(good(), {"--light", "moon"}), "moon", "noon");
}

TEST_F(BadInput, UnknownViewpoint) {
  expect_refused(render(good(), {"--viewpoint", "x", "--views", folder / "absent.json"}), "absent.json", "cannot read");
  const fs::path views =
      write_file(folder / "views.json", R"({"good": {"eye": [0, 8, 8], "target": [0, 0, 0], "fov": 45}})");
  expect_refused(render(good(), {"--viewpoint", "better", "--views", views}), "views.json", "better");
}

TEST_F(BadInput, WrongUsage) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--size", "0x18"}, "--size"},
      {{"--size", "32"}, "--size"},
      {{"--size", "32x-1"}, "--size"},
      {{"--size", "99999999999x18"}, "--size"},
      {{"--technique", "magic"}, "technique"},
      {{"--context", "vulkan"}, "context"},
      {{"--repeat", "0"}, "repeat"},
      {{"--grid", "many"}, "grid"},
      {{"--zcull", "maybe"}, "zcull"},
      {{"--sun", "10"}, "--sun"},
      {{"--sun", "10,100"}, "--sun"},
      {{"--sun", "nan,10"}, "--sun"},
      {{"--spot", "0,1,0,0,0,0,91"}, "--spot"},
      {{"--point", "0,1"}, "--point"},
      {{"--sun", "10,40;"}, "--sun"},
      {{"--eye", "0,1,2"}, "--target"},
      {{"--eye", "0,1,2", "--target", "0,1,2"}, "differ"},
      {{"--eye", "0,1,2", "--target", "0,0,0", "--camera", "above"}, "--camera"},
      {{"--fov", "180"}, "fov"},
      {{"--fov", "30"}, "--eye"},
      {{"--no-such-option"}, "--no-such-option"},
      {{"one-word-too-many"}, "one-word-too-many"},
  };
  for (const auto& [words, named] : cases) {
    const Outcome outcome = render(good(), words);
    EXPECT_EQ(outcome.code, 2) << words[0] << ": " << outcome.err;
    EXPECT_TRUE(outcome.says(named)) << words[0] << ": " << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << words[0] << ": " << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("izb: ")) << words[0] << ": " << outcome.err;
    EXPECT_EQ(names_in(output), std::vector<std::string>{}) << words[0];
  }
}

TEST_F(BadInput, CommandsThatAreNotComplete) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"paint"},
                                                {"render"},
                                                {"render", "x.glb"},
                                                {"validate"},
                                                {"scene"},
                                                {"scene", "moon"}}) {
    const Outcome outcome = izb::test::izb(words);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(words) << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("izb: ")) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(BadInput, ScenesOfOtherSizes) {
  for (const auto& [words, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"scene", "moon", "-o", "x.glb"}, "moon"},
           {{"scene", "villa", "-o", "x.glb", "--triangles", "-5"}, "--triangles"},
           {{"scene", "villa", "-o", "x.glb", "--triangles", "many"}, "--triangles"},
           {{"scene", "garden", "-o", "x.glb", "--triangles", "5000"}, "no other number"}}) {
    const Outcome outcome = izb::test::izb(words);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(words) << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.says(text)) << outcome.err;
  }
}

TEST_F(BadInput, SizeBeyondTheDrivers) {
  expect_refused(render(good(), {"--size", "1000000x18"}), "1000000x18", "pixels");
}

TEST_F(BadInput, MoreMemoryThanThereIs) {
  const RunOptions little{{{"IZB_MEMORY_BYTES", "20000000"}}, false};
  expect_refused(render(good(), {"--grid", "2048"}, little), "not enough memory: ", "gbuffer");
  const Outcome outcome = render(good(), {"--grid", "2048", "--cascades", "2", "--spp", "32"}, little);
  for (const char* part : {"(izb ", "IZB_MEMORY_BYTES has 20.0 MB left", "--grid", "--cascades", "--size", "--nodes"})
    EXPECT_TRUE(outcome.says(part)) << part << "\n" << outcome.err;
  expect_refused(render(good(), {}, {{{"IZB_MEMORY_BYTES", "little"}}, false}), "IZB_MEMORY_BYTES", "'little'");
  EXPECT_EQ(render(good(), {"--grid", "64", "--pairs", "16"}, little).code, 0);
}

TEST_F(BadInput, ASizeThatNoMachineHasMemoryFor) {
  const Outcome outcome =
      render(good(), {"--size", "16384x16384", "--cascades", "8", "--grid", "16384", "--spp", "32"});
  EXPECT_EQ(outcome.code, 1);
  ASSERT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
  EXPECT_TRUE(outcome.says("--size") && outcome.says("--grid") && outcome.says("--cascades")) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(names_in(output), std::vector<std::string>{});
}

TEST_F(BadInput, ValidateSaysThatMemoryIsShort) {
  const Outcome outcome =
      izb::test::izb({"validate", good(), "--size", "320x180"}, {{{"IZB_MEMORY_BYTES", "20000000"}}, false});
  expect_refused(outcome, "not enough memory: ", "--grid");
}

TEST_F(BadInput, ExactInsertionsPoolThatDoesNotFit) {
  // What is known beforehand takes 4.5 MB; then each of the grid's 2^20 texels gets a node.
  const Outcome outcome = render(good(),
                                 {"--spp", "32", "--insertion", "exact", "--grid", "1024", "--grid-density", "0",
                                  "--zcull", "off", "--occluders", "off", "--pairs", "16"},
                                 {{{"IZB_MEMORY_BYTES", "6000000"}}, false});
  expect_refused(outcome, "exact insertion", "--grid");
}

// ---- the output
// -----------------------------------------------------------------------------------------------------

TEST_F(BadInput, OutputInAMissingFolder) {
  for (const char* option : {"-o", "--preview", "--json"}) {
    const fs::path target = folder / "absent" / "file";
    expect_refused(izb::test::izb({"render", good(), option, target}), target, "does not exist");
  }
}

TEST_F(BadInput, OutputThatIsADirectory) {
  expect_refused(izb::test::izb({"render", good(), "-o", output}), output, "directory");
}

TEST_F(BadInput, OutputThatMayNotBeWritten) {
  const RunOptions nobody{{}, true};
  if (izb::test::izb({"--version"}, nobody).code != 0) GTEST_SKIP() << "another user may not run this build";
  const fs::path scene = good();
  fs::permissions(output, fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
  expect_refused(render(scene, {}, nobody), output / "frame", "Permission denied");
}

TEST_F(BadInput, FullDevice) {
  const auto full = full_device(folder / ".");
  if (!full) GTEST_SKIP() << "no full device";
  const fs::path scene = good();
  for (const char* option : {"-o", "--preview", "--json"}) {
    const Outcome outcome = izb::test::izb({"render", scene, option, *full, "--size", "32x18"});
    EXPECT_EQ(outcome.code, 1) << option;
    EXPECT_TRUE(outcome.says(full->string())) << outcome.err;
    EXPECT_TRUE(outcome.says("No space left on device")) << outcome.err;
    EXPECT_TRUE(fs::is_character_file(*full));
  }
  const Outcome outcome = izb::test::izb({"scene", "garden", "-o", *full});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("No space left on device")) << outcome.err;
}

TEST_F(BadInput, OneFileForTwoOutputs) {
  const fs::path same = output / "same";
  expect_refused(izb::test::izb({"render", good(), "-o", same, "--preview", output / "." / "same"}), "same",
                 "--output and --preview", 2);
}

TEST_F(BadInput, WhereOneOutputFailsNoneAppears) {
  const auto full = full_device(folder / ".");
  if (!full) GTEST_SKIP() << "no full device";
  for (const char* bad : {"-o", "--preview", "--json"}) {
    std::vector<std::string> words{"render", good(), "--size", "32x18"};
    for (const char* option : {"-o", "--preview", "--json"}) {
      words.push_back(option);
      words.push_back(option == std::string(bad) ? *full : output / (std::string("frame") + option));
    }
    expect_refused(izb::test::izb(words), *full, "No space left on device");
  }
}

TEST_F(BadInput, AHeatMapThatCannotBeWrittenIsKnownBeforeTheWork) {
  const fs::path json = output / "verdicts.json", absent = folder / "absent" / "map.png";
  const auto validate = [&](const fs::path& heatmap, const std::vector<fs::path>& scenes) {
    std::vector<std::string> words{"validate", "--json", json, "--heatmap", heatmap, "--size", "32x18"};
    words.insert(words.end(), scenes.begin(), scenes.end());
    return izb::test::izb(words);
  };
  // Scenes that are not there would be named if the work had begun.
  expect_refused(validate(absent, {folder / "no.glb"}), absent, "does not exist");
  expect_refused(validate(output, {folder / "no.glb"}), output, "directory");
  expect_refused(validate(absent, {folder / "no.glb", folder / "nor.glb"}), "map.no.png", "does not exist");
  expect_refused(validate(json, {folder / "no.glb"}), json, "--json and --heatmap", 2);
  expect_refused(validate(output / "map.png", {folder / "a" / "no.glb", folder / "b" / "no.glb"}), "map.no.png",
                 "name the same file", 2);
}

TEST_F(BadInput, WhereOneSceneFailsNoVerdictsAppear) {
  const fs::path json = write_file(output / "verdicts.json", "old"), map = write_file(output / "map.good.png", "old");
  const Outcome outcome = izb::test::izb(
      {"validate", good(), folder / "absent.glb", "--json", json, "--heatmap", output / "map.png", "--size", "32x18"});
  if (outcome.says("Embree")) GTEST_SKIP() << "this build has no Embree";
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(names_in(output), (std::vector<std::string>{"map.good.png", "verdicts.json"}));
  EXPECT_EQ(fs::file_size(json), 3u);
  EXPECT_EQ(fs::file_size(map), 3u);
}

TEST_F(BadInput, WhereAVerdictsFileFailsNoneAppears) {
  const auto full = full_device(folder / ".");
  if (!full) GTEST_SKIP() << "no full device";
  for (const char* bad : {"--json", "--heatmap"}) {
    std::vector<std::string> words{"validate", good(), "--size", "32x18"};
    for (const char* option : {"--json", "--heatmap"}) {
      words.push_back(option);
      words.push_back(option == std::string(bad) ? *full : output / "verdicts");
    }
    const Outcome outcome = izb::test::izb(words);
    if (outcome.says("Embree")) GTEST_SKIP() << "this build has no Embree";
    EXPECT_EQ(outcome.code, 1) << bad;
    EXPECT_TRUE(outcome.says(full->string() + "': No space left on device")) << outcome.err;
    EXPECT_EQ(names_in(output), std::vector<std::string>{}) << bad;
  }
}

TEST_F(BadInput, ASignalLeavesNothingBehind) {
  // So many frames that it is still at them when the signal comes.
  for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}}) {
    const Outcome outcome = run_program({"timeout", "--preserve-status", "-s", signal, "4", IZB_PROGRAM, "render",
                                         good(), "-o", output / "frame.exr", "--size", "32x18", "--repeat", "10000"});
    EXPECT_EQ(outcome.code, code) << signal << outcome.err;
    EXPECT_EQ(names_in(output), std::vector<std::string>{}) << signal;
  }
}

TEST_F(BadInput, ValidateStillReportsTheOtherScenes) {
  const Outcome outcome = izb::test::izb({"validate", folder / "absent.glb", good(), "--size", "32x18"});
  if (outcome.says("Embree")) GTEST_SKIP() << "this build has no Embree";
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.prints("good ")) << outcome.out;
  ASSERT_FALSE(outcome.error_lines().empty());
  EXPECT_NE(outcome.error_lines().back().find("absent.glb"), std::string::npos) << outcome.err;
}

TEST_F(BadInput, AnOldOutputSurvivesAFailure) {
  const fs::path old = write_file(output / "frame.exr", "old");
  EXPECT_EQ(render(folder / "absent.glb").code, 1);
  EXPECT_EQ(names_in(output), std::vector<std::string>{"frame.exr"});
  EXPECT_EQ(fs::file_size(old), 3u);
}

// ---- the machine
// ----------------------------------------------------------------------------------------------------

TEST_F(BadInput, WithoutGl45EveryContextIsNamed) {
  RunOptions old_gl{{{"MESA_GL_VERSION_OVERRIDE", "3.3"}, {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}, false};
  const Outcome outcome = render(good(), {}, old_gl);
  if (outcome.code == 0) GTEST_SKIP() << "this driver does not heed MESA_GL_VERSION_OVERRIDE";
  expect_refused(outcome, "no OpenGL 4.5 context (egl: ", "osmesa: ");
  EXPECT_TRUE(outcome.says("glfw: ")) << outcome.err;
}

TEST_F(BadInput, HardwareRasterWhereTheDriverLacksIt) {
  const fs::path scene = good();
  const Outcome outcome = render(scene, {"--raster", "hw"});
  if (outcome.code == 0) GTEST_SKIP() << "this driver has what --raster hw needs";
  expect_refused(outcome, "--raster hw needs ", "GL_NV_");
  if (!izb::test::izb({"info"}).prints("llvmpipe")) return;
  for (const char* extension : {"GL_NV_conservative_raster", "GL_NV_geometry_shader_passthrough"})
    EXPECT_TRUE(outcome.says(extension)) << outcome.err;
  expect_refused(izb::test::izb({"validate", scene, "--size", "32x18", "--raster", "hw"}), "--raster hw needs ",
                 "GL_NV_");
}

TEST_F(BadInput, ShaderFilesThatAreNotThere) {
  const Outcome outcome = render(good(), {}, {{{"IZB_GLSL", folder / "absent"}}, false});
  expect_refused(outcome, (folder / "absent").string(), "shader");
}

}  // namespace

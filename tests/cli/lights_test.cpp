// SPDX-License-Identifier: MIT
// Several lights at once: each has a mask, a channel and a hash of its own.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "image/exr.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;
using izb::Image;

/// The roof over the floor with three lights: a sun "noon", a point light "lamp" and a wide spot "beam".
GltfWriter three_lights() {
  GltfWriter gltf = roof_over_floor();
  json& lights = gltf.root["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"name", "lamp"}, {"type", "point"}, {"intensity", 40.0}});
  lights.push_back({{"name", "beam"}, {"type", "spot"}, {"intensity", 30.0}, {"spot", {{"outerConeAngle", 1.3}}}});
  json lamp = {{"translation", {1.5, 2.0, 0.5}}};
  lamp["extensions"]["KHR_lights_punctual"]["light"] = 1;
  gltf.add_root(lamp);
  json beam = {{"translation", {-2.0, 3.0, 0.0}}, {"rotation", {-0.7071067812, 0, 0, 0.7071067812}}};
  beam["extensions"]["KHR_lights_punctual"]["light"] = 2;
  gltf.add_root(beam);
  return gltf;
}

struct Lights : testing::Test {
  const TemporaryFolder folder;
  const fs::path scene = write_file(folder / "lights.glb", three_lights().glb());
  const fs::path exr = folder / "frame.exr", json_file = folder / "frame.json";

  Outcome render(std::vector<std::string> more) const {
    std::vector<std::string> words{"render", scene, "--size", "160x120", "--grid",
                                   "256",    "-o",  exr,      "--json",  json_file};
    words.insert(words.end(), more.begin(), more.end());
    return izb::test::izb(words);
  }
};

TEST_F(Lights, EachHasTheMaskThatItHasAlone) {
  ASSERT_EQ(render({"--light", "all"}).code, 0);
  const json all = read_json(json_file);
  const Image image = izb::read_exr(exr);
  ASSERT_EQ(all["lights"].size(), 3u);
  std::set<std::string> hashes{all["mask_hash"].get<std::string>()};
  uint64_t nodes = 0;
  for (const json& light : all["lights"]) {
    const std::string name = light["name"];
    ASSERT_EQ(render({"--light", name}).code, 0) << name;
    const json alone = read_json(json_file);
    EXPECT_EQ(light["mask_hash"], alone["mask_hash"]) << name;
    for (const char* count : {"fragments", "nodes", "lists", "longest_list", "receivers", "fully_shadowed"})
      EXPECT_EQ(light["counts"][count], alone["counts"][count]) << name << " " << count;
    EXPECT_GT(light["counts"]["visibility_tests"], 0) << name;
    nodes += light["counts"]["nodes"].get<uint64_t>();
    hashes.insert(light["mask_hash"].get<std::string>());
    const Image its = izb::read_exr(exr);
    EXPECT_EQ(image.uints("mask." + name), its.uints("mask")) << name;
    EXPECT_EQ(image.floats("visibility." + name), its.floats("visibility")) << name;
    EXPECT_EQ(image.floats("list_length." + name), its.floats("list_length")) << name;
  }
  EXPECT_EQ(all["counts"]["nodes"], nodes);
  EXPECT_EQ(hashes.size(), 4u);  // all different
  EXPECT_EQ(image.find("mask"), nullptr);
  EXPECT_EQ(std::get<std::string>(image.attributes.at("light.lamp.type")), "point");
}

TEST_F(Lights, OfTheCommandLineJoinThoseOfTheScene) {
  ASSERT_EQ(render({"--light", "beam;0", "--sun", "10,40;200,50", "--point", "0,3,1"}).code, 0);
  const json frame = read_json(json_file);
  std::vector<std::string> names;
  for (const json& light : frame["lights"]) names.push_back(light["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"beam", "noon", "sun", "sun 2", "point"}));
}

TEST_F(Lights, NamesThatDifferByADotHaveChannelsOfTheirOwn) {
  GltfWriter gltf = three_lights();
  json& lights = gltf.root["extensions"]["KHR_lights_punctual"]["lights"];
  lights[1]["name"] = "a.b", lights[2]["name"] = "a_b";
  write_file(scene, gltf.glb());
  ASSERT_EQ(render({"--light", "all"}).code, 0);
  const Image image = izb::read_exr(exr);
  for (const char* name : {"mask.noon", "mask.a_b", "mask.a_b 2"}) EXPECT_NE(image.find(name), nullptr) << name;
}

TEST_F(Lights, WithoutAChoiceTheFirstIsTakenAndTheOthersAreMentioned) {
  const Outcome outcome = render({});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.says("3 lights")) << outcome.err;
  EXPECT_TRUE(outcome.says("--light all")) << outcome.err;
  EXPECT_EQ(read_json(json_file)["lights"][0]["name"], "noon");
}

TEST_F(Lights, AnUnknownOneIsRefusedWithTheNamesThereAre) {
  const Outcome outcome = render({"--light", "noon;moon"});
  EXPECT_EQ(outcome.code, 1);
  for (const char* word : {"moon", "noon", "lamp", "beam"}) EXPECT_TRUE(outcome.says(word)) << outcome.err;
}

TEST_F(Lights, EachIsValidated) {
  const fs::path heat_map = folder / "heat.png";
  const Outcome outcome = izb::test::izb({"validate", scene, "--size", "120x90", "--light", "all", "--grid", "256",
                                          "--json", json_file, "--heatmap", heat_map});
  if (outcome.says("Embree") && outcome.code == 1) GTEST_SKIP() << "this build has no Embree";
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json reports = read_json(json_file);
  ASSERT_EQ(reports.size(), 3u);
  for (const json& report : reports) {
    EXPECT_EQ(report["unexplained"], 0);
    EXPECT_GT(report["shadowed"], 100) << report["light"];
    EXPECT_TRUE(outcome.prints("lights " + report["light"]["name"].get<std::string>())) << outcome.err;
  }
  EXPECT_EQ(reports[0].contains("points"), true);
  EXPECT_TRUE(fs::exists(heat_map));
}

}  // namespace

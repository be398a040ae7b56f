// SPDX-License-Identifier: MIT
// Several lights at once: each has a mask, a channel and a hash of its own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
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

std::string full(const std::array<double, 3>& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%.17g,%.17g,%.17g", v[0], v[1], v[2]);
  return text;
}

/// Where the sun of that azimuth and elevation shines to.
std::array<double, 3> away_from_sun(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * (M_PI / 180.0), e = elevation_deg * (M_PI / 180.0);
  return {-(std::sin(a) * std::cos(e)), -std::sin(e), std::cos(a) * std::cos(e)};
}

TEST_F(Lights, MovedAreThoseOfTheCommandLine) {
  const auto hash = [&](const std::vector<std::string>& words, size_t light = 0) {
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_json(json_file)["lights"][light]["mask_hash"].get<std::string>();
  };
  const std::string sun = full(away_from_sun(200, 50)), lamp = full({-1.0 / 3.0, 1.7, 0.1});
  EXPECT_EQ(hash({"--light", "noon", "--light-direction", sun}), hash({"--sun", "200,50"}));
  EXPECT_EQ(hash({"--light", "noon", "--light-direction", "0,-1e-200,1e-200"}), hash({"--sun", "0,45"}));
  EXPECT_EQ(hash({"--light", "lamp", "--light-position", lamp}), hash({"--point", lamp}));
  const std::string angle = "74.484513367007022";  // 1.3 radians
  EXPECT_EQ(hash({"--light", "beam", "--light-position", "2,4,1", "--light-direction", "-40,-80,-20"}),
            hash({"--spot", "2,4,1,0,0,0," + angle}));
  EXPECT_NE(hash({"--light", "beam", "--light-position", "2,4,1"}), hash({"--light", "beam"}));
  // In the order of --light; nothing between semicolons leaves one as it is.
  const std::vector<std::string> two{"--light", "beam;noon", "--light-direction", ";" + sun};
  EXPECT_EQ(hash(two, 0), hash({"--light", "beam"}));
  EXPECT_EQ(hash(two, 1), hash({"--sun", "200,50"}));
  const std::vector<std::string> all{"--light", "all", "--light-position", ";" + lamp + ";", "--light-direction", sun};
  EXPECT_EQ(hash(all, 0), hash({"--sun", "200,50"}));
  EXPECT_EQ(hash(all, 1), hash({"--point", lamp}));
  EXPECT_EQ(hash(all, 2), hash({"--light", "beam"}));
}

TEST_F(Lights, MovedStayThereWhereverTheirNodesGo) {
  GltfWriter gltf = three_lights();
  const int times = gltf.add_array(std::vector<float>{0, 1}, type_float, "SCALAR", 1);
  const int places = gltf.add_array(std::vector<float>{1, 2, 0, -1, 3, 0}, type_float, "VEC3", 3);
  const json lamp_node = gltf.root["nodes"].size() - 2;
  gltf.append(
      "animations",
      {{"name", "swing"},
       {"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", json::array({{{"sampler", 0}, {"target", {{"node", lamp_node}, {"path", "translation"}}}}})}});
  write_file(scene, gltf.glb());
  const auto hash = [&](const std::vector<std::string>& words) {
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_json(json_file)["mask_hash"].get<std::string>();
  };
  EXPECT_NE(hash({"--light", "lamp", "--time", "0"}), hash({"--light", "lamp", "--time", "1"}));
  const std::string here = hash({"--point", "0.5,2.5,0.5"});
  EXPECT_EQ(hash({"--light", "lamp", "--light-position", "0.5,2.5,0.5", "--time", "1"}), here);
  const fs::path frames = folder / "f####.json";
  ASSERT_EQ(izb::test::izb({"render", scene, "--size", "160x120", "--grid", "256", "--light", "lamp",
                            "--light-position", "0.5,2.5,0.5", "--frames", "0:1", "--fps", "1", "--json", frames})
                .code,
            0);
  for (const char* name : {"f0000.json", "f0001.json"}) EXPECT_EQ(read_json(folder / name)["mask_hash"], here) << name;
}

TEST_F(Lights, CannotBeMovedAsTheyAreNot) {
  const auto refuse = [&](std::vector<std::string> words, const std::vector<std::string>& says) {
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    for (const std::string& word : says) EXPECT_TRUE(outcome.says(word)) << word << ": " << outcome.err;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
  };
  refuse({"--light-position", "1,2,3"}, {"--light-position", "--light must say which"});
  refuse({"--sun", "0,40", "--light-direction", "1,2,3"}, {"--light-direction", "--light must say which"});
  refuse({"--light", "noon", "--light-position", "1,2,3"}, {"'noon'", "has no position"});
  refuse({"--light", "noon;lamp", "--light-direction", "1,2,3;1,2,3"}, {"'lamp'", "all directions"});
  refuse({"--light", "lamp", "--sun", "0,40", "--light-position", "1,2,3;4,5,6"}, {"2 entries", "1 lights"});
  refuse({"--light", "noon", "--light-direction", "0,0,0"}, {"must not be 0,0,0"});
  refuse({"--light", "lamp", "--light-position", "1,2"}, {"--light-position must be 3 numbers"});
  refuse({"--light", "lamp", "--light-position", "1,nan,2"}, {"--light-position must be 3 numbers"});
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

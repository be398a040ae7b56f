// SPDX-License-Identifier: MIT
// izb compare on files that are known, on frames of our own, and on whatever is wrong with either.
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "cli/run_program.h"
#include "cli/small_scenes.h"
#include "cpu/metric_pairs.h"
#include "image/exr.h"
#include "image/png.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;
using Words = std::vector<std::string>;

struct Compare : testing::Test {
  const TemporaryFolder folder;
  const fs::path output = folder / "output";
  const fs::path json = output / "numbers.json";
  Compare() { fs::create_directory(output); }

  /// `words` and --json.
  Outcome compare(Words words) const {
    words.insert(words.begin(), "compare");
    words.insert(words.end(), {"--json", json});
    return izb::test::izb(words);
  }

  nlohmann::json numbers(const Words& words) const {
    const Outcome outcome = compare(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_json(json);
  }

  /// One sentence, and nothing left behind.
  void expect_refused(const Outcome& outcome, const std::string& cause, int code = 1) const {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const Words lines = outcome.error_lines();
    ASSERT_EQ(lines.size(), 1u) << outcome.err;
    EXPECT_TRUE(lines[0].starts_with("izb: ")) << lines[0];
    EXPECT_NE(lines[0].find(cause), std::string::npos) << "no '" << cause << "' in: " << lines[0];
    EXPECT_EQ(names_in(output), Words{});
  }

  std::string exr(const std::string& name, const izb::Image& image) const {
    izb::write_exr(folder / name, image);
    return folder / name;
  }
};

izb::Image image_of(int width_px, int height_px, const std::map<std::string, float>& channels) {
  izb::Image image;
  image.width_px = width_px, image.height_px = height_px;
  for (const auto& [name, value] : channels) image.add(name, std::vector<float>(image.pixel_count(), value));
  return image;
}

const std::map<std::string, float> grey{{"R", 0.2f}, {"G", 0.2f}, {"B", 0.2f}};

izb::Image mask_image(std::vector<uint32_t> words, const std::string& name = "mask") {
  izb::Image image;
  image.width_px = int(words.size()), image.height_px = 1;
  image.add(name, std::move(words));
  return image;
}

// ---- pictures

TEST_F(Compare, KnownPairsHaveTheirNumbers) {
  for (const KnownPair& pair : known_pairs()) {
    const nlohmann::json j = numbers({metric_file(pair.name + "_reference.png"), metric_file(pair.name + "_test.png")});
    const nlohmann::json color = j["color"][0];
    EXPECT_NEAR(color["flip_max"], pair.expected["flip_max"], 1e-5) << pair.name;
    EXPECT_NEAR(color["rmse"], pair.expected["rmse"], 2e-8) << pair.name;
    EXPECT_NEAR(color["ssim"], pair.expected["ssim"], 2e-8) << pair.name;
    EXPECT_EQ(color["psnr_db"].is_null(), pair.name == "same");
    EXPECT_EQ(j["channels"], (Words{"B", "G", "R"}));
    EXPECT_EQ(j["reference"]["format"], "PNG");
    EXPECT_TRUE(j["command"].get<std::string>().starts_with("izb compare "));
    EXPECT_EQ(j["broken_limits"], nlohmann::json::array());
  }
}

TEST_F(Compare, PrintsATable) {
  const Outcome outcome = izb::test::izb({"compare", metric_file("leak_reference.png"), metric_file("leak_test.png")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* text : {"RMSE", "PSNR (dB)", "SSIM", "FLIP mean", "R G B", "0.035563", "28.980064", "0.951655"})
    EXPECT_TRUE(outcome.prints(text)) << text << "\n" << outcome.out;
}

TEST_F(Compare, ALimitThatIsBrokenIsSaidAndFails) {
  const Words pair{metric_file("leak_reference.png"), metric_file("leak_test.png")};
  const auto with = [&](Words words) {
    words.insert(words.begin(), pair.begin(), pair.end());
    return compare(words);
  };
  EXPECT_EQ(with({"--max-flip", "0.018", "--max-rmse", "0.04", "--min-psnr", "28", "--min-ssim", "0.95"}).code, 0);
  const std::pair<const char*, const char*> broken[] = {
      {"--max-flip", "0.017"}, {"--max-rmse", "0.035"}, {"--min-psnr", "29"}, {"--min-ssim", "0.96"}};
  for (const auto& [option, value] : broken) {
    const Outcome outcome = with({option, value});
    EXPECT_EQ(outcome.code, 1) << option;
    EXPECT_TRUE(outcome.says(std::string(option) + " " + value)) << outcome.err;
    EXPECT_TRUE(outcome.prints("FLIP mean"));  // the numbers are there all the same
    EXPECT_EQ(read_json(json)["broken_limits"], Words{std::string(option).substr(2)});
  }
  const Words same{metric_file("same_reference.png"), metric_file("same_test.png")};
  EXPECT_EQ(compare({same[0], same[1], "--min-psnr", "100", "--max-flip", "0"}).code, 0);  // infinite
}

TEST_F(Compare, ALimitOfWhatIsNotComparedIsRefused) {
  const Words pair{metric_file("leak_reference.png"), metric_file("leak_test.png")};
  expect_refused(compare({pair[0], pair[1], "--max-leaks", "1"}), "--max-leaks", 2);
  expect_refused(compare({pair[0], pair[1], "--max-unexplained", "0"}), "--max-unexplained", 2);
  const std::string small = exr("small.exr", image_of(4, 4, grey));
  expect_refused(compare({small, small, "--min-ssim", "0.5"}), "--min-ssim", 2);
}

TEST_F(Compare, ErrorMapsAreNumbersOrAPicture) {
  const Words pair{metric_file("leak_reference.png"), metric_file("leak_test.png")};
  const fs::path png = output / "map.png", numbers_map = output / "map.exr";
  EXPECT_EQ(compare({pair[0], pair[1], "--error-map", png}).code, 0);
  const izb::Image8 picture = izb::read_png(png);
  EXPECT_EQ(picture.width_px, 160);
  EXPECT_EQ(picture.height_px, 120);
  EXPECT_EQ(compare({pair[0], pair[1], "--error-map", numbers_map}).code, 0);
  const izb::Image errors = izb::read_exr(numbers_map);
  const std::vector<float>& flip = errors.floats("flip");
  EXPECT_NEAR(*std::max_element(flip.begin(), flip.end()), 0.870759, 1e-5);
  EXPECT_GT(flip[71 * 160 + 40], 0.2f);  // the leak
}

TEST_F(Compare, LinearColourIsComparedAsADisplayShowsIt) {
  const std::string bright = exr("bright.exr", image_of(16, 16, {{"R", 2.0f}, {"G", 2.0f}, {"B", 2.0f}}));
  const std::string brighter = exr("brighter.exr", image_of(16, 16, {{"R", 4.0f}, {"G", 4.0f}, {"B", 4.0f}}));
  EXPECT_EQ(numbers({bright, brighter})["color"][0]["rmse"], 0.0);  // both are white
  // At 2 stops less they are 0.5 and 1: 0.735357 against 1 in code values.
  EXPECT_NEAR(numbers({bright, brighter, "--exposure", "-2"})["color"][0]["rmse"], 1.0 - 0.7353569, 1e-6);
  EXPECT_EQ(read_json(json)["options"]["exposure"], -2.0);
  izb::write_png(folder / "white.png", izb::Image8{16, 16, 3, std::vector<uint8_t>(3 * 16 * 16, 255)});
  EXPECT_EQ(numbers({bright, folder / "white.png"})["color"][0]["flip_mean"], 0.0);
  fs::remove(json);
  expect_refused(compare({bright, folder / "white.png", "--exposure", "1"}), "--exposure", 2);
}

TEST_F(Compare, OtherChannelsAreValues) {
  izb::Image a = image_of(4, 2, {{"Z", 3.0f}, {"Y", 1.0f}}), b = a;
  std::get<std::vector<float>>(b.channels[1].data)[5] = 1.0f;
  const Words files{exr("a.exr", a), exr("b.exr", b)};
  const nlohmann::json j = numbers(files);
  ASSERT_EQ(j["values"].size(), 2u);
  EXPECT_EQ(j["values"][0]["name"], "Y");
  EXPECT_EQ(j["values"][0]["largest_difference"], 0.0);
  EXPECT_EQ(j["values"][1]["largest_difference"], 2.0);
  EXPECT_EQ(j["values"][1]["largest_at"], (std::vector<int>{1, 1}));
  EXPECT_FALSE(j.contains("color"));
  EXPECT_EQ(compare({files[0], files[1], "--max-difference", "1.9"}).code, 1);
  EXPECT_EQ(compare({files[0], files[1], "--channels", "Y", "--max-difference", "0"}).code, 0);
  EXPECT_EQ(compare({files[0], files[1], "--error-map", output / "d.exr"}).code, 0);
  EXPECT_EQ(izb::read_exr(output / "d.exr").floats("difference.Z")[5], -2.0f);
}

// ---- masks

TEST_F(Compare, MasksAreComparedBitByBit) {
  const Words files{exr("a.exr", mask_image({~0u, 0xFFu, 0, 0})), exr("b.exr", mask_image({~0u, 0x0Fu, 0x8u, 0}))};
  const nlohmann::json mask = numbers(files)["masks"][0];
  EXPECT_EQ(mask["spp"], 32);
  EXPECT_EQ(mask["bits"], 128);
  EXPECT_EQ(mask["differing"], 5);
  EXPECT_EQ(mask["leaks"], 4);
  EXPECT_EQ(mask["false_shadow"], 1);
  EXPECT_DOUBLE_EQ(mask["leak_percent"], 10.0);
  EXPECT_DOUBLE_EQ(mask["mean_coverage_error"], 5.0 / 32.0 / 4.0);
  EXPECT_EQ(compare({files[0], files[1], "--max-leaks", "10", "--max-differing-bits", "4"}).code, 0);
  EXPECT_EQ(compare({files[0], files[1], "--max-leaks", "9.9"}).code, 1);
  EXPECT_EQ(compare({files[0], files[1], "--max-false-shadow", "1"}).code, 1);
  EXPECT_EQ(compare({files[0], files[1], "--max-coverage-error", "0.03"}).code, 1);
  EXPECT_EQ(compare({files[0], files[1], "--error-map", output / "map.exr"}).code, 0);
  EXPECT_EQ(izb::read_exr(output / "map.exr").floats("coverage_error"),
            (std::vector<float>{0.0f, -0.125f, 1.0f / 32.0f, 0.0f}));
  EXPECT_EQ(compare({files[0], files[1], "--error-map", output / "map.png"}).code, 0);
}

TEST_F(Compare, OnlyReceiversCountWhereTheReferenceHasDepth) {
  izb::Image a = mask_image({~0u, 0, ~0u}), b = mask_image({~0u, ~0u, ~0u});
  a.add("depth", std::vector<float>{1.0f, 0.0f, 2.0f});
  const nlohmann::json mask = numbers({exr("a.exr", a), exr("b.exr", b)})["masks"][0];
  EXPECT_EQ(mask["spp"], 1);
  EXPECT_EQ(mask["pixels"], 2);
  EXPECT_EQ(mask["differing"], 0);
}

TEST_F(Compare, FramesOfTwoTechniquesAreCompared) {
  const fs::path scene = write_file(folder / "roof.glb", roof_over_floor().glb());
  const auto render = [&](const std::string& name, Words more) {
    Words words{"render", scene, "-o", folder / name, "--size", "64x36", "--spp", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return izb::test::izb(words);
  };
  ASSERT_EQ(render("izb.exr", {"--preview", folder / "izb.png"}).code, 0);
  const Outcome traced = render("traced.exr", {"--technique", "ray_traced"});
  if (traced.says("Embree")) GTEST_SKIP() << "this build has no Embree";
  // One has a channel list_length, the other has none: no part of the frame.
  const nlohmann::json j = numbers({folder / "traced.exr", folder / "izb.exr", "--max-differing-bits", "0"});
  EXPECT_EQ(j["channels"], (Words{"B", "G", "R", "mask"}));
  EXPECT_EQ(j["color"][0]["flip_max"], 0.0);
  EXPECT_GT(j["masks"][0]["shadowed"], 0);
  // A preview is the frame rounded to 8 bits: at most half a step, 0.5 / 255.
  const nlohmann::json rounded = numbers({folder / "izb.exr", folder / "izb.png", "--channels", "color"});
  EXPECT_LT(rounded["color"][0]["rmse"], 0.5 / 255.0);
  fs::remove(json);
  expect_refused(compare({folder / "izb.exr", folder / "izb.png"}), "only '" + (folder / "izb.exr").string());
  expect_refused(compare({folder / "traced.exr", folder / "izb.exr", "--channels", "all"}), "has list_length");
}

// ---- the truth

struct CompareTruth : Compare {
  const fs::path scene = write_file(folder / "roof.glb", roof_over_floor().glb());
  const std::string mask = folder / "frame.exr";
  // Off the scene's own camera, whose pixels' borders meet the roof's silhouette.
  const Words view{"--eye", "0,8,8.1", "--target", "0,0,0"};

  /// Whether there is a ray tracer to judge with.
  bool render(Words more = {}) const {
    Words words{"render", scene, "-o", mask, "--size", "64x36"};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = izb::test::izb(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return !std::regex_search(izb::test::izb({"info"}).out, std::regex("ray tracer +none"));
  }
  Outcome judge(Words more = {}) const {
    Words words{"--truth", scene, mask};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), more.begin(), more.end());
    return compare(words);
  }
};

TEST_F(CompareTruth, AnExactMaskHasNoUnexplainedBit) {
  if (!render({"--coverage", "exact", "--insertion", "exact"})) GTEST_SKIP() << "this build has no Embree";
  const Outcome outcome = judge({"--max-unexplained", "0"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json ours = read_json(json)["masks"][0];
  EXPECT_EQ(ours["spp"], 32);
  EXPECT_EQ(ours["unexplained"], 0);
  EXPECT_GT(ours["shadowed"], 0);
  // The same truth as that of validate.
  Words words{"validate", scene, "--size", "64x36", "--coverage", "exact", "--insertion", "exact", "--json", json};
  words.insert(words.end(), view.begin(), view.end());
  ASSERT_EQ(izb::test::izb(words).code, 0);
  const nlohmann::json validated = read_json(json);
  for (const char* key : {"explained", "unexplained", "leaks", "false_shadow", "disputed", "left_out"})
    EXPECT_EQ(ours[key], validated[key]) << key;
  EXPECT_EQ(ours["bits"], validated["compared"]);
}

TEST_F(CompareTruth, PlantedErrorsAreCounted) {
  if (!render({"--spp", "1"})) GTEST_SKIP() << "this build has no Embree";
  izb::Image frame = izb::read_exr(mask);
  std::vector<uint32_t> words = frame.uints("mask");
  const std::vector<float>& depth = frame.floats("depth");
  uint64_t leaks = 0, false_shadow = 0;
  for (size_t i = 0; i < words.size(); i += 3) {
    if (depth[i] == 0.0f) continue;
    (words[i] ? leaks : false_shadow) += 1;
    words[i] = ~words[i];
  }
  ASSERT_GT(leaks, 0u);
  izb::Image foreign;
  foreign.width_px = frame.width_px, foreign.height_px = frame.height_px;
  foreign.add("mask", words);
  izb::write_exr(mask, foreign);
  const Outcome outcome = judge({"--spp", "1", "--max-leaks", "1", "--error-map", output / "map.exr"});
  EXPECT_EQ(outcome.code, 1);
  const nlohmann::json j = read_json(json)["masks"][0];
  EXPECT_EQ(j["leaks"], leaks);
  EXPECT_EQ(j["false_shadow"], false_shadow);
  EXPECT_GT(j["unexplained"], 0);
  EXPECT_DOUBLE_EQ(j["mean_coverage_error"], double(leaks + false_shadow) / j["pixels"].get<double>());
  const std::vector<float> errors = izb::read_exr(output / "map.exr").floats("coverage_error");
  for (size_t i = 0; i < errors.size(); ++i) ASSERT_EQ(errors[i] != 0.0f, i % 3 == 0 && depth[i] > 0.0f) << i;
  EXPECT_EQ(judge({"--spp", "1", "--error-map", output / "map.png"}).code, 0);
  EXPECT_EQ(izb::read_png(output / "map.png").width_px, 64);
}

TEST_F(CompareTruth, EachLightHasItsMask) {
  if (!render({"--light", "noon", "--sun", "90,45"})) GTEST_SKIP() << "this build has no Embree";
  const Outcome outcome = judge({"--light", "noon", "--sun", "90,45"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json j = read_json(json);
  EXPECT_EQ(j["channels"], (Words{"mask.noon", "mask.sun"}));
  EXPECT_EQ(j["masks"].size(), 2u);
  fs::remove(json);
  expect_refused(judge(), "no channel 'mask'");
}

TEST_F(CompareTruth, WhatDoesNotFitIsRefused) {
  if (!render()) GTEST_SKIP() << "this build has no Embree";
  expect_refused(judge({"--size", "32x18"}), "--size is 32x18");
  expect_refused(judge({"--spp", "1"}), "--spp 1");
  expect_refused(judge({"--channels", "mask"}), "--channels", 2);
  expect_refused(compare({"--truth", scene, mask, mask}), "one file", 2);
  expect_refused(compare({"--truth", folder / "absent.glb", mask}), "absent.glb");
  expect_refused(compare({"--truth", scene, metric_file("leak_test.png")}), "PNG");
  izb::Image floats = image_of(64, 36, {{"mask", 1.0f}});
  izb::write_exr(mask, floats);
  expect_refused(judge(), "holds floats");
}

// ---- what is wrong

TEST_F(Compare, WrongFilesAreRefused) {
  const std::string good = exr("good.exr", image_of(4, 3, grey));
  const std::string text = write_file(folder / "text.exr", "no image");
  const std::string cut = write_file(folder / "cut.png", std::string("\x89PNG\r\n\x1a\n", 8));
  expect_refused(compare({good, folder / "absent.exr"}), "absent.exr");
  expect_refused(compare({good, text}), "neither OpenEXR nor PNG");
  expect_refused(compare({good, write_file(folder / "empty.png", "")}), "neither OpenEXR nor PNG");
  expect_refused(compare({cut, good}), "cut.png");
  expect_refused(compare({good, folder / "."}), "directory");
  expect_refused(compare({good, exr("wide.exr", image_of(5, 3, grey))}), "4 x 3 pixels");
  expect_refused(compare({good, exr("grey.exr", image_of(4, 3, {{"Y", 0.2f}}))}), "only '" + good + "' has B, G, R");
  expect_refused(compare({good, good, "--channels", "Q"}), "no channel 'Q', but B, G, R");
  expect_refused(compare({good, good, "--channels", ""}), "--channels", 2);
  expect_refused(compare({good, "/dev/zero"}), "device");
  expect_refused(compare({good, good, "--channels", "masks"}), "unsigned integers");
  const std::string ints = exr("ints.exr", mask_image({1, 2})),
                    floats = exr("floats.exr", image_of(2, 1, {{"mask", 1}}));
  expect_refused(compare({ints, floats}), "unsigned integers");
}

TEST_F(Compare, WhatIsNotFiniteIsRefused) {
  const std::string good = exr("good.exr", image_of(4, 3, grey));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    izb::Image image = image_of(4, 3, grey);
    std::get<std::vector<float>>(image.channels[1].data)[6] = bad;
    const std::string file = exr("bad.exr", image);
    expect_refused(compare({good, file}), "'" + file + "' has a");
    expect_refused(compare({file, good}), "in channel 'G' at pixel (2, 1)");
    EXPECT_EQ(compare({good, file, "--channels", "R;B"}).code, 0);  // what is not compared may be anything
    fs::remove(json);
  }
}

TEST_F(Compare, WrongUsageIsRefused) {
  const std::string good = exr("good.exr", image_of(4, 3, grey));
  expect_refused(compare({good}), "two files", 2);
  expect_refused(compare({}), "FILE", 2);
  expect_refused(compare({good, good, good}), "two files", 2);
  expect_refused(compare({good, good, "--sun", "0,45"}), "--truth", 2);
  expect_refused(compare({good, good, "--spp", "1"}), "--truth", 2);
  expect_refused(compare({good, good, "--error-map", output / "map.jpg"}), ".png or .exr", 2);
  expect_refused(compare({good, good, "--ppd", "0"}), "--ppd", 2);
  expect_refused(compare({good, good, "--max-flip", "2"}), "--max-flip", 2);
  expect_refused(compare({good, good, "--error-map", json}), ".png or .exr", 2);
  expect_refused(izb::test::izb({"compare", good, good, "--json", output / "a.exr", "--error-map", output / "a.exr"}),
                 "same file", 2);
}

TEST_F(Compare, AnOutputThatCannotBeWrittenIsRefused) {
  const std::string good = exr("good.exr", image_of(4, 3, grey));
  expect_refused(izb::test::izb({"compare", good, good, "--json", output / "absent" / "a.json"}), "absent");
  expect_refused(izb::test::izb({"compare", good, good, "--error-map", folder / "absent" / "a.png"}), "absent");
}

}  // namespace

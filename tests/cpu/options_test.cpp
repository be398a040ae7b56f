// SPDX-License-Identifier: MIT
#include "base/options.h"

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <climits>
#include <limits>
#include <stdexcept>

#include "base/error.h"

namespace {

using izb::OptionSet;
using testing::Test;

struct Options : Test {
  bool zcull = true;
  int grid = 2048, repeat = 1;
  double fov_deg = 45.0, bias = 0.0;
  std::string technique = "izb", light;
  OptionSet set;
  CLI::App app;

  Options() {
    set.flag("zcull", zcull, "Cull in light space before the visibility tests")
        .integer("grid", grid, 16, 16384, "texels", "Side of the light grid")
        .integer("repeat", repeat, 1, INT_MAX, "", "Render so often")
        .number("fov", fov_deg, 1.0, 179.0, "degrees", "Vertical field of view")
        .number("bias", bias, -std::numeric_limits<double>::infinity(), 2.5, "", "Shift")
        .choice("technique", technique, {"izb", "ray_traced"}, "How shadows are found")
        .text("light", light, "NAME|INDEX", "The light that casts shadows");
    set.add_to(app, "Shadows");
  }

  /// The message of the parse error, or "" if there is none.
  std::string parse(const std::string& line) {
    try {
      app.parse(line);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(Options, AreReadFromTheCommandLine) {
  EXPECT_EQ(parse("--zcull off --grid 512 --fov 30.5 --bias -3 --technique ray_traced --light sun"), "");
  EXPECT_FALSE(zcull);
  EXPECT_EQ(grid, 512);
  EXPECT_EQ(fov_deg, 30.5);
  EXPECT_EQ(bias, -3.0);
  EXPECT_EQ(technique, "ray_traced");
  EXPECT_EQ(light, "sun");
  EXPECT_EQ(repeat, 1);
  EXPECT_EQ(parse("--zcull on"), "");
  EXPECT_TRUE(zcull);
}

TEST_F(Options, LastOfARepeatedSwitchCounts) {
  EXPECT_EQ(parse("--grid 64 --grid 128"), "");
  EXPECT_EQ(grid, 128);
}

TEST_F(Options, AcceptTheEndsOfTheirRange) {
  EXPECT_EQ(parse("--grid 16"), "");
  EXPECT_EQ(parse("--grid 16384"), "");
  EXPECT_EQ(parse("--fov 179"), "");
  EXPECT_EQ(parse("--repeat 2147483647"), "");
  EXPECT_EQ(repeat, INT_MAX);
}

TEST_F(Options, RefuseWrongValuesInOneSentence) {
  EXPECT_EQ(parse("--grid 15"), "--grid must be a whole number from 16 to 16384 (texels), not '15'");
  EXPECT_EQ(parse("--grid 16385"), "--grid must be a whole number from 16 to 16384 (texels), not '16385'");
  EXPECT_EQ(parse("--grid 99999999999"), "--grid must be a whole number from 16 to 16384 (texels), not '99999999999'");
  EXPECT_EQ(parse("--grid 20x"), "--grid must be a whole number from 16 to 16384 (texels), not '20x'");
  EXPECT_EQ(parse("--grid 20.5"), "--grid must be a whole number from 16 to 16384 (texels), not '20.5'");
  EXPECT_EQ(parse("--repeat 0"), "--repeat must be a whole number of at least 1, not '0'");
  EXPECT_EQ(parse("--fov wide"), "--fov must be a number from 1 to 179 (degrees), not 'wide'");
  EXPECT_EQ(parse("--fov nan"), "--fov must be a number from 1 to 179 (degrees), not 'nan'");
  EXPECT_EQ(parse("--bias inf"), "--bias must be a number of at most 2.5, not 'inf'");
  EXPECT_EQ(parse("--bias -inf"), "--bias must be a number of at most 2.5, not '-inf'");
  EXPECT_EQ(parse("--technique pcf"), "--technique must be izb or ray_traced, not 'pcf'");
  EXPECT_EQ(grid, 2048);
  EXPECT_EQ(repeat, 1);
  EXPECT_EQ(fov_deg, 45.0);
  EXPECT_EQ(bias, 0.0);
  EXPECT_EQ(technique, "izb");
}

TEST_F(Options, FlagsTakeOnAndOffOnly) {
  for (const std::string word : {"true", "1", "ON", "yes"}) {
    EXPECT_EQ(parse("--zcull " + word), "--zcull must be on or off, not '" + word + "'");
  }
  EXPECT_NE(parse("--zcull"), "");
  EXPECT_TRUE(zcull);
}

TEST_F(Options, HelpNamesUnitRangeAndDefaultOfTheDeclaration) {
  grid = 512;
  const std::string help = app.help();
  const std::string lines[] = {
      "Shadows:",
      "--zcull on|off",
      "Cull in light space before the visibility tests (default on)",
      "--grid N",
      "Side of the light grid (texels, 16 to 16384; default 2048)",
      "Render so often (at least 1; default 1)",
      "--fov X",
      "Vertical field of view (degrees, 1 to 179; default 45)",
      "Shift (at most 2.5; default 0)",
      "--technique izb|ray_traced",
      "How shadows are found (default izb)",
      "--light NAME|INDEX",
      "The light that casts shadows\n",
  };
  for (const std::string& line : lines) EXPECT_NE(help.find(line), std::string::npos) << line << "\nin\n" << help;
}

TEST_F(Options, JsonHoldsTheCurrentValues) {
  ASSERT_EQ(parse("--zcull off --grid 512"), "");
  const nlohmann::json expected = {{"zcull", false}, {"grid", 512},        {"repeat", 1}, {"fov", 45.0},
                                   {"bias", 0.0},    {"technique", "izb"}, {"light", ""}};
  EXPECT_EQ(set.to_json(), expected);
}

TEST_F(Options, AreListedWithTheirFacts) {
  ASSERT_EQ(set.options().size(), 7u);
  const izb::Option& option = set.options()[1];
  EXPECT_EQ(option.name, "grid");
  EXPECT_EQ(option.unit, "texels");
  EXPECT_EQ(option.min, 16.0);
  EXPECT_EQ(option.max, 16384.0);
  EXPECT_EQ(option.default_value, 2048);
  option.set("64");
  EXPECT_EQ(grid, 64);
  EXPECT_THROW(option.set("8"), izb::UsageError);
}

TEST_F(Options, MistakesInDeclarationsAreFound) {
  EXPECT_THROW(set.flag("grid", zcull, "again"), std::logic_error);
  int outside = 5;
  EXPECT_THROW(set.integer("outside", outside, 6, 7, "", ""), std::logic_error);
  std::string unknown = "unknown";
  EXPECT_THROW(set.choice("unknown", unknown, {"a", "b"}, ""), std::logic_error);
}

}  // namespace

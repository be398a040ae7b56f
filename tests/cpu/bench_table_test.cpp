// SPDX-License-Identifier: MIT
#include "app/bench/report_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace izb::bench;
using nlohmann::json;

TEST(BenchTable, IsCsvWithUnitsGroupsAndWhoseNumbersTheyAre) {
  ReportTable table("t", "Caption",
                    {{.name = "scene", .text = true},
                     {.name = "ours", .unit = "ms", .group = "build"},
                     {.name = "theirs", .unit = "ms", .group = "build", .paper = true}});
  EXPECT_TRUE(table.empty());
  table.add({"villa", 1.25, 1.7});
  table.add({"a, \"b\"\nc", no_value("it takes x, or y"), 3});
  table.add({"\"", "\n", "x\r"});  // each alone needs quotes
  EXPECT_FALSE(table.empty());
  EXPECT_EQ(csv_of(table.json()),
            "scene,build: ours (ms),\"build: theirs, paper (ms)\"\r\n"
            "villa,1.25,1.7\r\n"
            "\"a, \"\"b\"\"\nc\",\"n/a: it takes x, or y\",3\r\n"
            "\"\"\"\",\"\n\",\"x\r\"\r\n");
}

TEST(BenchTable, KeepsNumbersInFull) {
  ReportTable table("t", "", {{.name = "a"}, {.name = "b", .digits = 0}});
  const double third = 1.0 / 3.0;
  table.add({third, uint64_t(1) << 62});
  const std::string csv = csv_of(table.json());
  const size_t line = csv.find("\r\n") + 2, comma = csv.find(',', line);
  EXPECT_EQ(std::stod(csv.substr(line, comma - line)), third);
  EXPECT_EQ(csv.substr(comma + 1), "4611686018427387904\r\n");
}

TEST(BenchTable, IsWhatTheReportTakes) {
  ReportTable table("t", "Caption", {{.name = "scene", .text = true}, {.name = "n", .unit = "ms", .digits = 2}});
  table.add({"villa", 1.0});
  const json& its = table.json();
  EXPECT_EQ(its["id"], "t");
  EXPECT_EQ(its["columns"][0], (json{{"name", "scene"}, {"source", "measured"}, {"align", "left"}}));
  EXPECT_EQ(its["columns"][1], (json{{"name", "n"}, {"source", "measured"}, {"unit", "ms"}, {"digits", 2}}));
}

TEST(BenchTable, RefusesRowsAndCellsThatSayNothing) {
  ReportTable table("t", "", {{.name = "a"}, {.name = "b"}});
  EXPECT_THROW(table.add({1.0}), std::logic_error);
  table.add({1.0, nullptr});
  EXPECT_THROW(csv_of(table.json()), std::logic_error);
}

}  // namespace

// SPDX-License-Identifier: MIT
// The report's page as text: what is escaped, refused, and how numbers are written. How it behaves in a browser:
// tests/cli/report_browser_test.cpp.
#include "app/bench/report.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "app/bench/report_assets.h"
#include "app/bench/report_html.h"
#include "base/error.h"
#include "base/file.h"
#include "cpu/gltf_writer.h"
#include "report_example.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;
using izb::report::number_text;
using nlohmann::json;

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

json table_document(const json& columns, const json& rows) {
  return {{"title", "t"},
          {"sections",
           {{{"id", "s"},
             {"title", "S"},
             {"tables", {{{"id", "t"}, {"caption", "c"}, {"columns", columns}, {"rows", rows}}}}}}}};
}

json plot_document() {
  return {{"title", "t"},
          {"sections",
           {{{"id", "s"},
             {"title", "S"},
             {"plots",
              {{{"id", "p"},
                {"title", "P"},
                {"kind", "line"},
                {"x", {{"values", {1, 2, 3}}}},
                {"y", {{"label", "time"}, {"unit", "ms"}}},
                {"series",
                 {{{"name", "a"}, {"values", {1.5, nullptr, 2.5}}}, {{"name", "b"}, {"values", {3, 4, 5}}}}}}}}}}}};
}

json& plot_of(json& document) {
  return document["sections"][0]["plots"][0];
}

/// The sentence with which a document is refused; empty: it is not.
std::string refusal(const json& document, const fs::path& folder = ".") {
  try {
    izb::make_report(document, folder);
  } catch (const izb::Error& error) {
    return error.what();
  }
  return {};
}

TEST(Report, HoldsAllOfTheExample) {
  const TemporaryFolder folder;
  const json document = report_example(folder / "");
  const std::string page = izb::make_report(document, folder / "");
  EXPECT_EQ(count(page, "<section "), 4u);
  EXPECT_EQ(count(page, "<figure class=\"table"), 2u);
  EXPECT_EQ(count(page, "<figure class=\"plot"), 7u);
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,iVBOR"), 3u);
  EXPECT_TRUE(has(page, "These times are of a software renderer"));
  // One of the four sections is of a GPU: it is not marked, nor is its table.
  EXPECT_EQ(count(page, izb::report::software_badge()), 1u + 3u + 1u + 7u);
  for (const char* elsewhere : {"src=\"http", "href=\"http", "@import", "url(http", "<link"})
    EXPECT_FALSE(has(page, elsewhere)) << elsewhere;
}

TEST(Report, TextOfStrangersStaysText) {
  const std::string hostile = "</script><script>alert(1)</script><!--\"'&\x01";
  json document = plot_document();
  document["title"] = document["subtitle"] = hostile;
  document["facts"] = json::array({{hostile, hostile}});
  json& section = document["sections"][0];
  section["title"] = hostile;
  section["text"] = section["notes"] = json::array({hostile});
  section["tables"] = {{{"id", "t"},
                        {"caption", hostile},
                        {"columns", {{{"name", hostile}, {"unit", hostile}, {"group", hostile}, {"align", "left"}}}},
                        {"rows", {{hostile}, {{{"reason", hostile}}}}}}};
  plot_of(document)["title"] = hostile;
  plot_of(document)["x"] = {{"label", hostile}, {"scale", "category"}, {"values", {hostile, hostile, "c"}}};
  plot_of(document)["series"][0]["name"] = hostile;
  const std::string page = izb::make_report(document, ".");
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "\x01"));
  EXPECT_TRUE(has(page, "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!--&quot;&#39;&amp;\uFFFD"));
  EXPECT_TRUE(has(page, "\\u003c/script>\\u003cscript>alert(1)"));
  // Each script that is opened is one of ours, and is closed.
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
  EXPECT_EQ(izb::report::prose("a `b<` c`d"), "a <code>b&lt;</code> c`d");
}

TEST(Report, BytesThatAreNotUtf8AreReplaced) {
  const std::string page =
      izb::make_report(table_document({{{"name", "scene"}}}, {{"caf\xE9.glb"}, {"café.glb"}}), ".");
  EXPECT_FALSE(has(page, "\xE9.glb"));
  EXPECT_TRUE(has(page, "caf\uFFFD."));
  EXPECT_TRUE(has(page, "café."));
}

TEST(Report, NumbersAreWrittenForReading) {
  EXPECT_EQ(number_text(12, {}), "12");
  EXPECT_EQ(number_text(-1234567, {}), "\u22121,234,567");
  EXPECT_EQ(number_text(12, 1), "12.0");
  EXPECT_EQ(number_text(1999.96, 1), "2,000.0");
  EXPECT_EQ(number_text(999.96, 1), "1,000.0");
  EXPECT_EQ(number_text(-0.04, 1), "0.0");
  EXPECT_EQ(number_text(0.1, {}), "0.1");
  EXPECT_EQ(number_text(1.0 / 3.0, {}), "0.333333");
  EXPECT_EQ(number_text(2.5e-7, {}), "2.5e-07");
  EXPECT_EQ(number_text(1234567.8, {}), "1,234,568");
  EXPECT_EQ(number_text(uint64_t(18446744073709551615u), 0), "18,446,744,073,709,551,615");
}

TEST(Report, CellsKeepTheirNumbersAndTheirReasons) {
  const json columns{
      {{"name", "scene"}, {"align", "left"}},
      {{"name", "time"}, {"unit", "ms"}, {"digits", 1}, {"source", "measured"}, {"empty", "no such stage"}},
      {{"name", "time"}, {"unit", "ms"}, {"digits", 1}, {"source", "paper"}}};
  const json rows{{"a", 1234.56, 2},
                  {"b", {{"reason", "timed out"}}, {{"value", 3.25}, {"note", "by eye"}}},
                  {"c, \"d\"", nullptr, {{"reason", "timed out"}}}};
  const std::string page = izb::make_report(table_document(columns, rows), ".");
  EXPECT_TRUE(has(page, "<td class=\"num\" data-value=\"1234.56\">1,234.6</td>"));
  EXPECT_TRUE(has(page, "<td class=\"num paper\" data-value=\"2\">2.0</td>"));
  EXPECT_TRUE(has(page, "<span class=\"source\">paper</span>"));
  // Each sentence stands once below the table, and cells point to it.
  EXPECT_TRUE(has(page,
                  "<li id=\"t-a\"><sup>a</sup> timed out</li>\n<li id=\"t-b\"><sup>b</sup> by eye</li>\n"
                  "<li id=\"t-c\"><sup>c</sup> no such stage</li>"));
  EXPECT_EQ(count(page, "href=\"#t-a\""), 2u);
  EXPECT_EQ(count(page, "href=\"#t-b\""), 1u);

  const izb::report::Document document = izb::report::read_document(table_document(columns, rows));
  EXPECT_EQ(izb::report::csv(document.sections[0].tables[0]),
            "scene,time (ms) [measured],time (ms) [paper],notes\r\n"
            "a,1234.56,2,\r\n"
            "b,,3.25,time (ms) [measured]: timed out; time (ms) [paper]: by eye\r\n"
            "\"c, \"\"d\"\"\",,,time (ms) [measured]: no such stage; time (ms) [paper]: timed out\r\n");
}

TEST(Report, AnEmptyCellNeedsAReason) {
  const json columns{{{"name", "a"}}};
  const std::string why =
      "the report's document does not fit: sections[0].tables[0].rows[1][0]: it is empty, and neither it "
      "nor \"empty\" of the column says why";
  EXPECT_EQ(refusal(table_document(columns, {{1}, {nullptr}})), why);
  EXPECT_EQ(refusal(table_document(columns, {{1}, {std::numeric_limits<double>::quiet_NaN()}})), why);
}

TEST(Report, SaysWhereADocumentDoesNotFit) {
  const json columns{{{"name", "a"}}, {{"name", "b"}}};
  EXPECT_EQ(refusal(table_document(columns, {{1, 2}, {1}})),
            "the report's document does not fit: sections[0].tables[0].rows[1]: 1 cells for 2 columns");
  EXPECT_EQ(refusal(table_document({{{"name", "a"}, {"digit", 1}}}, json::array())),
            "the report's document does not fit: sections[0].tables[0].columns[0]: there is no key \"digit\"");
  EXPECT_EQ(refusal({{"sections", json::array()}}),
            "the report's document does not fit: at the top: \"title\" is missing");
  EXPECT_EQ(refusal({{"title", 1}, {"sections", json::array()}}),
            "the report's document does not fit: title: a string is expected");

  const auto changed = [](const char* pointer, const json& value) {
    json document = plot_document();
    document[json::json_pointer(std::string("/sections/0") + pointer)] = value;
    return refusal(document);
  };
  EXPECT_EQ(changed("/id", "s"), "");
  for (const auto& [pointer, value, words] : std::initializer_list<std::tuple<const char*, json, const char*>>{
           {"/id", "a b", "is no id"},
           {"/plots/1", plot_document()["sections"][0]["plots"][0], "is the id of something else"},
           {"/plots/0/kind", "pie", "\"pie\" is none of line, bars, stacked"},
           {"/plots/0/kind", "bars", "bars have categories"},
           {"/plots/0/x/values", {1, 1, 2}, "the values must rise"},
           {"/plots/0/x/values", json::array(), "it has no values"},
           {"/plots/0/x/scale", "log", ""},
           {"/plots/0/x/scale", "category", "a string is expected"},
           {"/plots/0/y/scale", "category", "y has no categories"},
           {"/plots/0/y/scale", "log", ""},
           {"/plots/0/y/digits", 1.5, "a whole number from 0 to 9"},
           {"/plots/0/series", json::array(), "it has no series"},
           {"/plots/0/series/1/name", "a", "\"a\" is there twice"},
           {"/plots/0/series/0/values", {1, 2}, "2 values for 3 of x"},
           {"/plots/0/series/0/values", {1, 2, "3"}, "a number or null is expected"},
           {"/plots/0/series/0/low", {1, 2, 3}, "come together"}}) {
    const std::string sentence = changed(pointer, value);
    EXPECT_TRUE(*words ? has(sentence, words) : sentence.empty()) << pointer << ": " << sentence;
  }
  json log = plot_document();
  plot_of(log)["y"]["scale"] = "log";
  plot_of(log)["series"][0]["values"][0] = 0;
  EXPECT_TRUE(has(refusal(log), "sections[0].plots[0].series[0].values[0]: 0 has no logarithm")) << refusal(log);
}

TEST(Report, SoftwareAndGpuNeverStandInOnePlot) {
  json document = plot_document();
  json& series = plot_of(document)["series"];
  series[0]["software"] = true;
  EXPECT_THROW(izb::make_report(document, "."), std::logic_error);  // the other is of a GPU, as its section is
  series[1]["software"] = true;
  EXPECT_TRUE(has(izb::make_report(document, "."), izb::report::software_badge()));
  plot_of(document)["software"] = false;
  EXPECT_THROW(izb::make_report(document, "."), std::logic_error);
  // The paper's times are of a GPU and always stand apart: dashed.
  plot_of(document).erase("software");
  series[1].erase("software");
  series[1]["source"] = "paper";
  EXPECT_NO_THROW(izb::make_report(document, "."));
}

TEST(Report, ImagesAreThereWholeAndOfOneShape) {
  const TemporaryFolder folder;
  const izb::Image8 wide{4, 2, 3, std::vector<uint8_t>(24, 200)}, tall{2, 4, 3, std::vector<uint8_t>(24, 200)};
  izb::write_png(folder / "wide.png", wide);
  izb::write_png(folder / "tall.png", tall);
  const auto document = [](const std::vector<std::string>& names) {
    json files = json::array();
    for (const std::string& name : names) files.push_back({{"file", name}, {"label", "l"}});
    return json{{"title", "t"},
                {"sections", {{{"id", "s"}, {"title", "S"}, {"images", {{{"title", "i"}, {"files", files}}}}}}}};
  };
  EXPECT_EQ(refusal(document({"wide.png", "wide.png"}), folder / ""), "");
  EXPECT_TRUE(has(refusal(document({"wide.png", "tall.png"}), folder / ""), "another aspect ratio (4 x 2)"));
  EXPECT_TRUE(has(refusal(document({"none.png"}), folder / ""), "none.png': No such file"));
  const std::string bytes = izb::read_text_file(folder / "wide.png");
  write_file(folder / "cut.png", bytes.substr(0, bytes.size() - 20));
  EXPECT_TRUE(has(refusal(document({"cut.png"}), folder / ""), "cut.png' as PNG"));
}

/// $IZB_REPORT for the time of a test.
struct AssetsElsewhere {
  explicit AssetsElsewhere(const fs::path& folder) { setenv("IZB_REPORT", folder.c_str(), 1); }
  ~AssetsElsewhere() { unsetenv("IZB_REPORT"); }
};

TEST(Report, WithoutD3ThereAreTheValuesAndASentence) {
  const TemporaryFolder folder;
  const fs::path assets = folder / "report";
  fs::copy(izb::report::assets_folder(), assets);
  fs::remove(assets / "d3.min.js");
  const AssetsElsewhere elsewhere(assets);
  const std::string page = izb::make_report(plot_document(), ".");
  EXPECT_TRUE(has(page, "The plot is not drawn: this build of izb has no d3."));
  EXPECT_TRUE(has(page, "<td class=\"num\" data-value=\"2.5\">2.5</td>"));
  EXPECT_FALSE(has(page, "Mike Bostock"));

  write_file(assets / "d3.min.js", "// a library\n");
  const std::string with = izb::make_report(plot_document(), ".");
  EXPECT_FALSE(has(with, "not drawn"));
  EXPECT_TRUE(has(with, "// a library\n"));
  EXPECT_TRUE(has(with, "Mike Bostock"));  // its licence

  fs::remove(assets / "report.css");
  EXPECT_TRUE(has(refusal(plot_document()), "report.css"));
}

}  // namespace

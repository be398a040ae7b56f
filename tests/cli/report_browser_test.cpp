// SPDX-License-Identifier: MIT
// The report in a browser: headless Chromium opens the file, a script does what a reader does, and nothing may stand on
// the console.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/bench/report.h"
#include "app/bench/report_assets.h"
#include "base/file.h"
#include "cli/run_program.h"
#include "cpu/gltf_writer.h"
#include "report_example.h"

namespace {

namespace fs = std::filesystem;
using namespace izb::test;

/// Chromium by one of its names; empty: there is none.
std::string find_browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (run_program({name, "--version"}).code == 0) return name;
  return {};
}

struct Visit {
  std::string dom;                   ///< the page at the end, as HTML
  std::vector<std::string> console;  ///< what was written to the console, exceptions included

  /// The text of the element that a script left.
  std::string left(const std::string& id) const {
    const size_t found = dom.find(" id=\"" + id + "\">");
    const size_t from = found == dom.npos ? found : dom.find('>', found) + 1;
    return from == dom.npos ? std::string() : dom.substr(from, dom.find("</", from) - from);
  }
};

struct ReportInABrowser : testing::Test {
  static inline std::string browser;
  const TemporaryFolder folder;

  static void SetUpTestSuite() { browser = find_browser(); }
  void SetUp() override {
    if (browser.empty()) GTEST_SKIP() << "no browser is there: it takes Chromium (Debian package chromium)";
    if (izb::report::read_assets().d3.empty()) GTEST_SKIP() << "this build has no d3 (Debian package node-d3)";
  }

  std::string example() const { return izb::make_report(report_example(folder / ""), folder / ""); }

  Visit visit(const std::string& page) const {
    write_file(folder / "report.html", page);
    // A browser that hangs is ended by force; root may not use the sandbox, and containers have no session bus.
    const Outcome outcome =
        run_program({"timeout", "-k", "5", "60", browser, "--headless=new", "--no-sandbox", "--disable-gpu",
                     "--hide-scrollbars", "--no-first-run", "--disable-dev-shm-usage", "--enable-logging=stderr",
                     "--user-data-dir=" + (folder / "profile").string(), "--virtual-time-budget=10000",
                     "--window-size=1300,900", "--dump-dom", "file://" + (folder / "report.html").string()},
                    {{{"HOME", (folder / "").string()}}, false});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    Visit visit{outcome.out, {}};
    for (const std::string& line : outcome.error_lines())
      if (line.find(":CONSOLE") != std::string::npos) visit.console.push_back(line);
    return visit;
  }
};

/// The page with a script of ours at its end, or before its own.
std::string with_script(std::string page, const std::string& script, bool first = false) {
  const std::string place = first ? "<style>" : "</body>";
  return page.insert(page.rfind(place), "<script>" + script + "</script>");
}

TEST_F(ReportInABrowser, AnErrorWouldBeSeen) {
  // The last is what the page's policy forbids: to ask for something from elsewhere.
  const Visit read = visit(with_script(example(),
                                       "setTimeout(() => { throw new Error('planted exception'); });"
                                       "console.error('planted error');"
                                       "new Image().src = 'http://localhost:1/planted.png';"));
  ASSERT_EQ(read.console.size(), 3u);
  for (const std::string& line : read.console) EXPECT_NE(line.find("planted"), std::string::npos) << line;
}

TEST_F(ReportInABrowser, DoesWhatAReaderAsksFor) {
  // A browser that only prints the page draws a frame every few seconds: what waits for one goes on at once.
  const std::string page =
      with_script(example(), "window.requestAnimationFrame = (next) => setTimeout(next, 1);", true);
  const Visit read = visit(with_script(page, izb::read_text_file(IZB_SOURCE_DIR "/tests/cli/report_checks.js")));
  for (const std::string& line : read.console) ADD_FAILURE() << line;
  const std::string left = read.left("findings");
  ASSERT_FALSE(left.empty()) << "the checks did not come to their end";
  const json findings = json::parse(left);
  for (const json& finding : findings)
    EXPECT_TRUE(finding["ok"].get<bool>()) << finding["what"] << ": " << finding["seen"];
  EXPECT_GT(findings.size(), 80u);
}

TEST_F(ReportInABrowser, FitsAPhoneAndKeepsTheTheme) {
  const std::string kept = with_script(example(), "localStorage.setItem('izb-report-theme', 'dark')", true);
  write_file(
      folder / "inner.html",
      with_script(kept,
                  "setTimeout(() => parent.postMessage([innerWidth, document.documentElement.scrollWidth, "
                  "document.documentElement.dataset.theme, document.querySelectorAll('.stage > svg .series').length]"
                  ".join(' '), '*'), 500)"));
  // A window has a least width; a frame has not.
  const Visit read = visit(
      "<!DOCTYPE html><iframe src=\"inner.html\" width=\"360\" height=\"800\"></iframe><p id=\"findings\"></p>"
      "<script>onmessage = (event) => { document.getElementById('findings').textContent = event.data; };</script>");
  for (const std::string& line : read.console) ADD_FAILURE() << line;
  // Tables scroll within their boxes, not the page. A series is a line, a bar, or bars that are stacked.
  EXPECT_EQ(read.left("findings"), fmt::format("360 360 dark {}", 12 + 3 + 1 + 2 + 1 + 34 + 8));
}

TEST_F(ReportInABrowser, WithoutD3ItSaysSo) {
  fs::copy(izb::report::assets_folder(), folder / "report");
  fs::remove(folder / "report/d3.min.js");
  setenv("IZB_REPORT", (folder / "report").c_str(), 1);
  const std::string page = example();
  unsetenv("IZB_REPORT");
  const Visit read = visit(page);
  for (const std::string& line : read.console) ADD_FAILURE() << line;
  EXPECT_NE(read.dom.find("this build of izb has no d3"), std::string::npos);
  EXPECT_NE(read.dom.find("data-index"), std::string::npos);  // tables are still alive
}

}  // namespace

// SPDX-License-Identifier: MIT
// bench/changes.sh: what changed between two results.
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "cli/small_scenes.h"

namespace izb::test {
namespace {

namespace fs = std::filesystem;

struct Changes : testing::Test {
  const TemporaryFolder folder;
  const fs::path a = folder / "a b", b = folder / "b\\n";  // names are names
  Changes() {
    fs::create_directory(a);
    fs::create_directory(b);
  }

  static Outcome changes(const std::vector<std::string>& words) {
    std::vector<std::string> all{IZB_SOURCE_DIR "/bench/changes.sh"};
    all.insert(all.end(), words.begin(), words.end());
    return run_program(all);
  }
  /// Of two tables: what is printed below the first line.
  std::string of(const std::string& before, const std::string& after) const {
    const Outcome outcome = changes({write_file(a / "t.csv", before), write_file(b / "t.csv", after)});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out.substr(std::min(outcome.out.size(), outcome.out.find('\n') + 1));
  }
};

const std::string head = "\n| row | column | A | B | change |\n|---|---|---|---|---|\n";

TEST_F(Changes, OfNumbersAreInPercentTheLargestFirst) {
  EXPECT_EQ(of("scene,x (ms),y (ms),z\r\nvilla,2,100,1e3\r\ntown,-4,0,7\r\n",
               "scene,x (ms),y (ms),z\r\nvilla,3,99,1000.0\r\ntown,-3,1,7\r\n"),
            head +
                "| town | y (ms) | 0 | 1 | was 0 |\n"
                "| villa | x (ms) | 2 | 3 | +50.0 % |\n"
                "| town | x (ms) | -4 | -3 | +25.0 % |\n"
                "| villa | y (ms) | 100 | 99 | -1.0 % |\n"
                "\n2 values are the same.\n");
}

TEST_F(Changes, OfPercentsBelowZeroAreInPoints) {
  EXPECT_EQ(of("option,time (%),error (%)\na,-0.5,4\nb,10,1\n", "option,time (%),error (%)\na,1.5,2\nb,7,1\n"),
            head +
                "| a | error (%) | 4 | 2 | -50.0 % |\n"
                "| b | time (%) | 10 | 7 | -3.0 points |\n"
                "| a | time (%) | -0.5 | 1.5 | +2.0 points |\n"
                "\n1 value is the same.\n");
}

TEST_F(Changes, ReadQuotedCells) {
  EXPECT_EQ(of("\"a, \"\"b\"\"\nc\",n\r\n\"x|\ny\",1\r\n", "\"a, \"\"b\"\"\nc\",n\n\"x|\ny\",2"),
            head + "| x\\| y | n | 1 | 2 | +100.0 % |\n");
  EXPECT_EQ(of("s,n\nu,1\n", "\xEF\xBB\xBFs,n\nu,1\n"), "\n1 value is the same.\n");
}

TEST_F(Changes, MatchRowsByTheirTexts) {
  EXPECT_EQ(of("scene,technique,ms\nvilla,izb,1\nvilla,rays,2\ntown,izb,3\n",
               "scene,technique,ms\ntown,izb,6\nvilla,izb,1\nvilla,map,5\n"),
            head +
                "| town, izb | ms | 3 | 6 | +100.0 % |\n"
                "\n1 value is the same.\n\nRows only in A: villa, rays\n\nRows only in B: villa, map\n");
}

TEST_F(Changes, MatchRowsByNumbersWhereTextsDoNotTellThemApart) {
  EXPECT_EQ(of("scene,samples,ms\nvilla,32,10\nvilla,1,5\n", "scene,samples,ms\nvilla,1,4\nvilla,32,10\n"),
            head + "| villa, 1 | ms | 5 | 4 | -20.0 % |\n\n1 value is the same.\n");
  // Nothing tells them apart.
  EXPECT_EQ(of("s,n\nu,1\nu,1\n", "s,n\nu,1\nu,1\n"), "");
}

TEST_F(Changes, SayWhatIsNoNumber) {
  EXPECT_EQ(of("scene,ms,which,\"ms, paper\"\nvilla,\"n/a: it broke\",one,1\ntown,5,two,2\n",
               "scene,ms,which,\"ms, paper\"\nvilla,2,three,3\ntown,n/a: no,two,2\n"),
            head +
                "| villa | ms | n/a: it broke | 2 | changed |\n"
                "| villa | which | one | three | changed |\n"
                "| town | ms | 5 | n/a: no | changed |\n"
                "\n1 value is the same.\n");
}

TEST_F(Changes, SayWhichColumnsAreNew) {
  EXPECT_EQ(of("s,old,n\nu,1,1\n", "s,n,new (ms)\nu,1,1\n"),
            "\n1 value is the same.\n\nColumns only in A: old\n\nColumns only in B: new (ms)\n");
}

TEST_F(Changes, OfFoldersAreThoseOfTheirTablesAndConditions) {
  for (const fs::path& path : {a, b}) {
    write_file(path / "same.csv", "s,n\nu,1\n");
    write_file(path / ("only in " + path.filename().string().substr(0, 1) + ".csv"), "s,n\n");
  }
  write_file(a / "t.csv", "s,n\nu,1\n");
  write_file(b / "t.csv", "s,n\nu,2\n");
  json report = json::parse(R"({
    "facts": [["machine", "a \"fast\" one"], ["command", "izb bench x"], ["written", "today"], ["izb", "1"]],
    "sections": [{"id": "table1", "facts": [["picture", "1x1"], ["32 samples", "`--spp 32`"]], "tables": []},
                 {"id": "memory", "facts": []},
                 {"id": "peers", "facts": [["picture", "1x1"]]}]})");
  write_file(a / "report.json", report.dump(1));
  report["facts"][0][1] = "a slow one";
  report["facts"][1][1] = "izb bench y";
  report["facts"][2][1] = "tomorrow";
  report["sections"][0]["facts"][1][1] = "`--spp 1`";
  report["sections"][2]["facts"][0][1] = "2x2";
  write_file(b / "report.json", report.dump(1));
  const Outcome outcome = changes({a, b});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "Changes from A, `" + a.string() + "`, to B, `" + b.string() +
                             "`\n\n- machine differs: a \"fast\" one; now a slow one\n"
                             "- table1: 32 samples differs: `--spp 32`; now `--spp 1`\n"
                             "- peers: picture differs: 1x1; now 2x2\n"
                             "\n## same\n\n1 value is the same.\n\n## t\n" +
                             head +
                             "| u | n | 1 | 2 | +100.0 % |\n"
                             "\nTables only in A: only in a\n\nTables only in B: only in b\n");
  fs::remove(b / "report.json");
  EXPECT_TRUE(changes({a, b}).prints("has no report.json"));
  EXPECT_TRUE(changes({a.string() + "/", b}).prints("## t"));
}

TEST_F(Changes, RefuseWhatTheyCannotCompare) {
  const Outcome help = changes({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(help.prints("usage: bench/changes.sh A B")) << help.out;
  EXPECT_EQ(changes({}).code, 2);
  EXPECT_EQ(changes({a}).code, 2);
  EXPECT_EQ(changes({a, b, a}).code, 2);
  EXPECT_EQ(changes({"--unknown", b}).code, 2);
  const auto fails = [&](const fs::path& from, const fs::path& to, const std::string& sentence) {
    const Outcome outcome = changes({from, to});
    EXPECT_EQ(outcome.code, 1) << outcome.out;
    EXPECT_EQ(outcome.error_lines().size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.says(sentence)) << outcome.err;
  };
  fails(a, folder / "missing", "is not there");
  fails(a, b, "no table is in both");
  const fs::path good = write_file(folder / "good.csv", "s,n\nu,1\n");
  fails(a, good, "is a folder, and one is not");
  fails(good, write_file(folder / "bad.csv", "s,n\nu,\"1\n"), "is no CSV table");
  fails(good, write_file(folder / "bad.csv", ""), "is no CSV table");
  fails(write_file(folder / "bad.csv", "s,n\nu,1,2\n"), good, "has 3 cells in row 1 and not 2");
}

}  // namespace
}  // namespace izb::test

// SPDX-License-Identifier: MIT
// izb bench, interrupted in every way at any moment, and gone on with.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/vfs.h>

#include <random>

#include "cli/bench_program.h"

namespace {

using namespace izb::test;
using Jobs = std::vector<std::string>;

using BenchResume = BenchProgram;

const Jobs all_jobs{"memory town (shadow map 2048)", "memory town (rays, 32 samples)", "peers town"};

double seconds_of(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void change_json(const fs::path& path, auto&& change) {
  json its = read_json(path);
  change(its);
  write_file(path, its.dump());
}

TEST_F(BenchResume, MeasuresOnlyWhatIsMissing) {
  Outcome outcome = bench();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(measured(outcome), all_jobs);
  expect_complete(3);

  outcome = bench();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("holds results already: --resume goes on with them")) << outcome.err;

  const fs::path deleted = out / "runs/memory/town.rays__32_samples.json", kept = out / "runs/peers/town.json";
  const auto time = fs::last_write_time(kept);
  fs::remove(deleted);
  outcome = bench({"--resume"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(measured(outcome), Jobs{all_jobs[1]});
  EXPECT_EQ(fs::last_write_time(kept), time);
  expect_complete(3);

  outcome = bench({"--resume"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(measured(outcome), Jobs());
}

TEST_F(BenchResume, TakesNoResultThatIsNotTheJobs) {
  json sweeps = quick_sweeps();
  json& list = sweeps["memory"]["configurations"];
  const auto name = [](int i) { return "map " + std::to_string(i); };
  constexpr int count = 7;
  list = json::array();
  for (int i = 0; i < count; ++i) list.push_back(map_configuration(name(i)));
  set_sweeps(sweeps);
  ASSERT_EQ(bench().code, 0);
  const auto path = [&](int i) { return out / "runs/memory" / ("town.map_" + std::to_string(i) + ".json"); };
  change_json(path(0), [](json& j) { j["job"]["frames"] = 9; });
  change_json(path(1), [](json& j) { j["made"]["version"] = "0.0.0 (other)"; });
  change_json(path(2), [](json& j) { j = {{"job", j["job"]}, {"made", j["made"]}, {"failed", "it had a bad day"}}; });
  fs::resize_file(path(3), fs::file_size(path(3)) / 2);
  write_file(path(4), "[]");
  change_json(path(5), [](json& j) { j.erase("made"); });
  // Of the pictures one is gone; the truth is damaged, too, and made again.
  fs::remove(out / "images/peers-town-gain-1.png");
  const std::vector<fs::path> truths = files(".exr");
  ASSERT_EQ(truths.size(), 1u);
  fs::resize_file(truths[0], 1000);
  const Outcome outcome = bench({"--resume"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  Jobs expected;
  for (int i = 0; i < count - 1; ++i) expected.push_back("memory town (" + name(i) + ")");
  expected.push_back("peers town");
  EXPECT_EQ(measured(outcome), expected);
  expect_complete(count + 1);
}

TEST_F(BenchResume, GoesOnFromElsewhereAndWithoutTablesOfAnotherPlan) {
  ASSERT_EQ(run_program({"env", "-C", folder / "", program, "bench", "all", "-o", "out"}).code, 0);
  Outcome outcome = bench({"--resume"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(measured(outcome), Jobs());
  EXPECT_TRUE(fs::exists(out / "peers.csv"));
  write_file(out / "notes.csv", "somebody's\r\n");
  outcome = run_program({program, "bench", "memory", "--resume", "-o", out});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(measured(outcome), Jobs());
  EXPECT_EQ(files(".csv"), (std::vector<fs::path>{out / "memory.csv", out / "notes.csv"}));
  // Another size is other work.
  outcome = run_program({program, "bench", "memory", "--resume", "--size", "16x16", "-o", out});
  EXPECT_EQ(measured(outcome).size(), 2u);
}

/// A run is stopped at a moment of each of so many equal parts of it; with $IZB_FULL of more.
struct Disturbed : BenchResume {
  const bool full = std::getenv("IZB_FULL");
  std::mt19937 random{2015};

  std::vector<double> moments(double whole, int parts) {
    if (full) parts = 50;
    std::vector<double> all;
    for (int i = 0; i < parts; ++i) all.push_back(whole * (i + std::uniform_real_distribution<>(0, 1)(random)) / parts);
    return all;
  }
  /// Seconds that a run takes, which leaves scenes and truths for none of the others.
  double undisturbed_s() {
    const double s = seconds_of([&] { EXPECT_EQ(bench().code, 0); });
    fs::remove_all(out);
    return s;
  }
  void expect_resumes() {
    const Outcome outcome = bench({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    expect_complete(3);
    fs::remove_all(out);
  }
};

TEST_F(Disturbed, ByCtrlCLeavesValidFiles) {
  for (const double moment_s : moments(undisturbed_s(), 6)) {
    SCOPED_TRACE(moment_s);
    Started run(words({"--resume"}), folder / "log");
    std::this_thread::sleep_for(std::chrono::duration<double>(moment_s));
    const int code = run.end(SIGINT);
    // It may have been done, or not have begun to catch it.
    EXPECT_TRUE(code == 1 || code == 0 || code == 128 + SIGINT) << code;
    EXPECT_TRUE(nothing_runs());
    expect_whole();
    EXPECT_EQ(files(".tmp"), std::vector<fs::path>());
    if (code == 1) {
      const std::string log = izb::read_text_file(folder / "log");
      EXPECT_NE(log.find("interrupted"), std::string::npos) << log;
      EXPECT_TRUE(fs::exists(out / "report.html"));
    }
    expect_resumes();
  }
}

TEST_F(Disturbed, ByDeathLeavesValidFiles) {
  for (const double moment_s : moments(undisturbed_s(), 4)) {
    SCOPED_TRACE(moment_s);
    Started run(words({"--resume"}), folder / "log");
    std::this_thread::sleep_for(std::chrono::duration<double>(moment_s));
    run.end(SIGKILL);
    EXPECT_TRUE(nothing_runs());
    expect_whole();
    expect_resumes();
  }
}

TEST_F(BenchResume, AJobThatIsKilledIsARowThatSaysSo) {
  json sweeps = quick_sweeps();
  sweeps["memory"]["configurations"][0]["options"]["resolution"] = "1024";
  sweeps["memory"]["frames"] = 1000000;
  json one = sweeps["memory"];
  one["configurations"].erase(1);
  sweeps["memory"] = one;
  set_sweeps(sweeps);
  Started run(words(), folder / "log");
  std::vector<pid_t> jobs;
  ASSERT_TRUE(eventually([&] { return !(jobs = processes_with({"bench-job", out, "shadow map 2048"})).empty(); }));
  EXPECT_EQ(jobs.size(), 1u);
  // Once it has a file open, so that there is something half written.
  ASSERT_TRUE(eventually([&] { return !files(".tmp").empty(); }));
  kill(jobs[0], SIGKILL);
  EXPECT_EQ(run.end(), 1);
  const json its = read_json(out / "runs/memory/town.shadow_map_2048.json");
  EXPECT_EQ(its["failed"], "ended by the system, as it does where memory is short");
  EXPECT_TRUE(its.contains("job") && its.contains("made"));
  EXPECT_TRUE(read_json(out / "runs/peers/town.json").contains("configurations"));
  EXPECT_NE(izb::read_text_file(out / "memory.csv").find("n/a: ended by the system"), std::string::npos);
  EXPECT_EQ(files(".tmp"), std::vector<fs::path>());
  expect_whole();
}

TEST_F(BenchResume, AJobDiesWithTheProcessThatStartedIt) {
  json sweeps = quick_sweeps();
  sweeps["memory"]["frames"] = 1000000;  // longer than anybody waits
  set_sweeps(sweeps);
  Started run(words(), folder / "log");
  ASSERT_TRUE(eventually([&] { return !processes_with({"bench-job", out}).empty(); }));
  run.end(SIGKILL);
  EXPECT_TRUE(nothing_runs());
}

TEST_F(BenchResume, AJobThatTakesTooLongIsARowThatSaysSo) {
  json sweeps = quick_sweeps();
  sweeps["memory"]["configurations"].erase(1);
  sweeps["memory"]["frames"] = 1000000;
  set_sweeps(sweeps);
  const Outcome outcome = bench({"--time-limit", "2"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(processes_with({"bench-job", out}).empty());
  EXPECT_TRUE(outcome.says("failed: not done after 2 s")) << outcome.err;
  EXPECT_TRUE(outcome.says("1 of 2 jobs failed: the report says why")) << outcome.err;
  EXPECT_EQ(read_json(out / "runs/memory/town.shadow_map_2048.json")["failed"], "not done after 2 s");
  EXPECT_NE(izb::read_text_file(out / "memory.csv").find("n/a: not done after 2 s"), std::string::npos);
  EXPECT_EQ(files(".tmp"), std::vector<fs::path>());
  expect_whole();
}

TEST_F(BenchResume, OneAtATimeInAFolder) {
  json sweeps = quick_sweeps();
  sweeps["memory"]["frames"] = 1000000;
  set_sweeps(sweeps);
  Started run(words(), folder / "log");
  ASSERT_TRUE(eventually([&] { return !processes_with({"bench-job", out}).empty(); }));
  const Outcome outcome = bench({"--resume"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.says("another izb bench is at work in")) << outcome.err;
  EXPECT_EQ(run.end(SIGTERM), 1);
  EXPECT_TRUE(nothing_runs());
  EXPECT_NE(izb::read_text_file(out / "report.json").find("2 of 2 jobs were not run until now."), std::string::npos);
}

TEST_F(BenchResume, WhatNohupIgnoresIsIgnored) {
  std::vector<std::string> nohup{"bash", "-c", "trap '' HUP; exec \"$@\"", "bash"};
  for (const std::string& word : words()) nohup.push_back(word);
  Started run(nohup, folder / "log");
  ASSERT_TRUE(eventually([&] { return !processes_with({"bench-job", out}).empty(); }));
  kill(run.pid(), SIGHUP);
  EXPECT_EQ(run.end(), 0) << izb::read_text_file(folder / "log");
  expect_complete(3);
}

/// A file system that a test fills, where the system allows to make one.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& folder) : folder_(folder) {
    fs::create_directories(folder_);
    mounted_ = unshare(CLONE_NEWNS) == 0 && mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
               mount("izb", folder_.c_str(), "tmpfs", 0, "size=1m") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }
  void resize(size_t bytes) const {
    const std::string size = "size=" + std::to_string(bytes);
    if (mount("izb", folder_.c_str(), "tmpfs", MS_REMOUNT, size.c_str()) != 0)
      throw std::runtime_error("cannot change the size of a disk");
  }
  size_t used() const {
    struct statfs its {};
    statfs(folder_.c_str(), &its);
    return size_t(its.f_blocks - its.f_bfree) * size_t(its.f_bsize);
  }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

TEST_F(Disturbed, ByAFullDiskLeavesValidFiles) {
  const SmallDisk disk(out);
  if (!disk.mounted()) GTEST_SKIP() << "no file system of its own can be mounted here";
  constexpr size_t enough = size_t(1) << 28;
  disk.resize(enough);
  ASSERT_EQ(bench().code, 0);
  const double most = double(disk.used()) - 8192;  // two blocks less than it takes
  const auto empty = [&] {
    for (const auto& entry : fs::directory_iterator(out)) fs::remove_all(entry.path());
  };
  for (const double bytes : moments(most, 3)) {
    SCOPED_TRACE(bytes);
    empty();
    disk.resize(size_t(bytes));
    Outcome outcome = bench();
    EXPECT_EQ(outcome.code, 1);
    ASSERT_FALSE(outcome.error_lines().empty());
    const std::string last = outcome.error_lines().back();
    EXPECT_TRUE(last.starts_with("izb: ")) << outcome.err;
    EXPECT_TRUE(last.find("No space left on device") != std::string::npos || outcome.says("jobs failed"))
        << outcome.err;
    expect_whole();
    EXPECT_EQ(files(".tmp"), std::vector<fs::path>());
    disk.resize(enough);
    outcome = bench({"--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    expect_complete(3);
  }
}

}  // namespace

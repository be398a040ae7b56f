// SPDX-License-Identifier: MIT
// `izb bench` with sweeps of its own, as an installed program has them beside it: small ones, that take seconds.
#pragma once
#include <csignal>
#include <regex>
#include <set>
#include <thread>

#include "app/bench/runner.h"
#include "base/file.h"
#include "cli/run_program.h"
#include "cli/small_scenes.h"

namespace izb::test {

namespace fs = std::filesystem;

/// A part of a sweep over the scenes that a test names.
inline json small_part(const std::string& measure, const std::vector<json>& configurations) {
  return {{"measure", measure}, {"scenes", {"town"}}, {"triangles", 600},
          {"size", "32x24"},    {"frames", 2},        {"configurations", configurations}};
}

inline json map_configuration(const std::string& name) {
  return {{"name", name}, {"technique", "shadow_map"}, {"options", {{"resolution", "64"}, {"filter", "none"}}}};
}

/// Three quick jobs, of which the last has a truth, with pictures.
inline json quick_sweeps() {
  json memory = small_part(
      "times", {map_configuration("shadow map 2048"), {{"name", "rays, 32 samples"}, {"technique", "ray_traced"}}});
  memory["settings"] = {{"process_each", true}};
  json peers = small_part("quality", {map_configuration("map 2048, unfiltered")});
  peers["settings"] = {{"truth_rays", 32}};
  peers["configurations"].push_back({{"name", "rays, 1 sample"},
                                     {"technique", "ray_traced"},
                                     {"options", {{"spp", "1"}}},
                                     {"notes", {{"role", "ours"}}}});
  return {{"memory", memory}, {"peers", peers}};
}

/// A process that has been started.
class Started {
 public:
  Started(const std::vector<std::string>& words, const fs::path& output) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ != 0) return;
    std::FILE* const file = std::fopen(output.c_str(), "wb");
    if (file) dup2(fileno(file), STDOUT_FILENO), dup2(fileno(file), STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Started() {
    if (pid_ > 0) end(SIGKILL);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  pid_t pid() const { return pid_; }
  /// Sends the signal, if any, and waits: the exit code, or 128 + the signal's number that ended it.
  int end(int signal = 0) {
    if (signal != 0) kill(pid_, signal);
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

/// Processes whose command line holds `words`, all of them.
inline std::vector<pid_t> processes_with(const std::vector<std::string>& words) {
  std::vector<pid_t> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream in(entry.path() / "cmdline", std::ios::binary);
    const std::string line((std::istreambuf_iterator<char>(in)), {});
    if (std::all_of(words.begin(), words.end(),
                    [&](const std::string& w) { return line.find(w) != std::string::npos; }))
      found.push_back(std::stoi(name));
  }
  return found;
}

/// Whether it becomes true before long: generously, since other work may hold the cores.
template <typename Condition>
bool eventually(Condition&& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

struct BenchProgram : testing::Test {
  const TemporaryFolder folder;
  const fs::path program = folder / "bin/izb", out = folder / "out";

  BenchProgram() {
    unsetenv("IZB_SCENES");
    fs::create_directories(folder / "bin");
    fs::create_directories(folder / "share/izb");
    fs::copy_file(IZB_PROGRAM, program);
    for (const char* name : {"views.json", "paper.json"})
      fs::copy_file(fs::path(IZB_SOURCE_DIR) / "bench" / name, folder / "share/izb" / name);
    set_sweeps(quick_sweeps());
  }

  /// Experiments that `sweeps` lacks have no jobs.
  void set_sweeps(json sweeps) const {
    for (const char* name :
         {"table1", "table2", "figure8", "figure9", "figure10", "ablations", "memory", "temporal", "peers"})
      if (!sweeps.contains(name)) sweeps[name] = json::array();
    write_file(folder / "share/izb/sweeps.json", sweeps.dump());
  }

  std::vector<std::string> words(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{program, "bench", "all", "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome bench(const std::vector<std::string>& more = {}, const RunOptions& options = {}) const {
    return run_program(words(more), options);
  }

  /// Its lines "[1/3] ...", without the numbers and times: which jobs it measured.
  static std::vector<std::string> measured(const Outcome& outcome) {
    std::vector<std::string> jobs;
    for (const std::string& line : outcome.error_lines()) {
      std::smatch match;
      if (std::regex_match(line, match, std::regex(R"(\[\d+/\d+\] (.*): \d+\.\d s.*)"))) jobs.push_back(match[1]);
    }
    return jobs;
  }

  std::vector<fs::path> files(const std::string& extension) const {
    std::vector<fs::path> found;
    if (!fs::exists(out)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(out))
      if (entry.path().extension() == extension) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Whatever has happened: what is there is whole, and a result is of the job that its name says.
  void expect_whole() const {
    for (const fs::path& path : files(".json")) {
      const json its = json::parse(read_text_file(path), nullptr, false);
      ASSERT_FALSE(its.is_discarded()) << path;
      if (path.parent_path() == out) continue;
      EXPECT_EQ(bench::result_path(bench::job_from(its.at("job")), out), path);
    }
    for (const fs::path& path : files(".html")) EXPECT_TRUE(read_text_file(path).ends_with("</html>\n")) << path;
    for (const fs::path& path : files(".csv")) EXPECT_TRUE(read_text_file(path).ends_with("\r\n")) << path;
  }

  /// A run that was not disturbed, or has been resumed.
  void expect_complete(size_t jobs) const {
    expect_whole();
    EXPECT_EQ(files(".tmp"), std::vector<fs::path>());
    EXPECT_TRUE(fs::exists(out / "report.html"));
    size_t results = 0;
    for (const fs::path& path : files(".json")) {
      if (path.parent_path() == out) continue;
      ++results;
      EXPECT_FALSE(read_json(path).contains("failed")) << read_text_file(path);
    }
    EXPECT_EQ(results, jobs);
  }

  bool nothing_runs() const {
    return eventually([&] { return processes_with({"bench-job", out}).empty(); });
  }
};

}  // namespace izb::test

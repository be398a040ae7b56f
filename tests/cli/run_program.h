// SPDX-License-Identifier: MIT
// Runs a program as a person would and keeps what it says.
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace izb::test {

inline nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(std::ifstream(path));
}

struct Outcome {
  int code = -1;         ///< exit code; 128 + the signal's number if one ended it
  std::string out, err;  ///< stdout and stderr

  std::vector<std::string> error_lines() const {
    std::vector<std::string> lines;
    std::istringstream in(err);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  bool says(const std::string& text) const { return err.find(text) != std::string::npos; }
  bool prints(const std::string& text) const { return out.find(text) != std::string::npos; }
};

struct RunOptions {
  std::map<std::string, std::string> environment;  ///< added to this process's own
  bool as_nobody = false;                          ///< root gives up its rights first
};

inline std::string read_all(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char bytes[4096];
  for (size_t n; (n = std::fread(bytes, 1, sizeof bytes, file)) > 0;) text.append(bytes, n);
  std::fclose(file);
  return text;
}

/// words[0] is looked up in PATH. Exit code 127: it cannot be run.
inline Outcome run_program(const std::vector<std::string>& words, const RunOptions& options = {}) {
  std::FILE* const out = std::tmpfile();
  std::FILE* const err = std::tmpfile();
  if (!out || !err) throw std::runtime_error("no temporary files");
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    dup2(fileno(out), STDOUT_FILENO);
    dup2(fileno(err), STDERR_FILENO);
    for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
    constexpr unsigned nobody = 65534;
    if (options.as_nobody && geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(127);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_all(out);
  outcome.err = read_all(err);
  return outcome;
}

/// The program under test, with KHR_debug on: a GL error or a message of high severity fails the test.
inline Outcome izb(std::vector<std::string> arguments, RunOptions options = {}) {
  arguments.insert(arguments.begin(), IZB_PROGRAM);
  options.environment["IZB_GL_DEBUG"] = "1";
  Outcome outcome = run_program(arguments, options);
  EXPECT_FALSE(outcome.says("warning: GL:")) << outcome.err;
  return outcome;
}

/// The names in a folder, sorted: what a run left behind.
inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace izb::test

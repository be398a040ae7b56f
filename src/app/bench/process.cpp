// SPDX-License-Identifier: MIT
#include "app/bench/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/error.h"

namespace izb::bench {
namespace {

volatile sig_atomic_t asked_to_end = 0;

void note_signal(int) {
  asked_to_end = 1;
}

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before it could be waited for
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  execv("/proc/self/exe", arguments);
  _exit(127);
}

/// Asks it to end, and makes it after a second.
void end(pid_t child, int& status) {
  kill(child, SIGTERM);
  for (int i = 0; i < 100; ++i) {
    if (waitpid(child, &status, WNOHANG) == child) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGKILL);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;  // what is being written is written
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted() {
  return asked_to_end != 0;
}

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0) fail("cannot open the folder '{}': {}", folder.string(), std::strerror(errno));
  held_ = flock(folder_, LOCK_EX | LOCK_NB) == 0;
  if (held_ || errno != EWOULDBLOCK) return;
  close(folder_);
  fail("another izb bench is at work in '{}'", folder.string());
}

FolderLock::~FolderLock() {
  close(folder_);
}

ChildEnd run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log_path,
                   double time_limit_s) {
  std::vector<std::string> words{"izb"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int log = open(log_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (log < 0) fail("cannot write '{}': {}", log_path.string(), std::strerror(errno));
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(pointers.data(), log, parent);
  const int error = errno;
  close(log);
  if (child < 0) fail("cannot start a process: {}", std::strerror(error));

  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(time_limit_s);
  ChildEnd result;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) != child) {
    result.timed_out = std::chrono::steady_clock::now() > deadline;
    result.interrupted = interrupted();
    if (result.timed_out || result.interrupted) {
      end(child, status);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  result.interrupted = interrupted();
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace izb::bench

// SPDX-License-Identifier: MIT
#include "view/child.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace izb::test {

Child::Child(const std::vector<std::string>& words, const Environment& added)
    : out_(std::tmpfile()), err_(std::tmpfile()) {
  if (!out_ || !err_) throw std::runtime_error("no temporary files");
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("cannot fork");
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);  // the test died in between
    dup2(fileno(out_), STDOUT_FILENO);
    dup2(fileno(err_), STDERR_FILENO);
    for (const auto& [name, value] : added) setenv(name.c_str(), value.c_str(), 1);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
}

Child::~Child() {
  kill();
  std::fclose(out_);
  std::fclose(err_);
}

bool Child::runs() {
  if (pid_ < 0) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  pid_ = -1;
  return false;
}

void Child::end() {
  if (!runs()) return;
  ::kill(pid_, SIGTERM);
  wait(10.0);
}

void Child::kill() {
  if (!runs()) return;
  ::kill(pid_, SIGKILL);
  wait(60.0);
}

bool Child::wait(double timeout_s) {
  return wait_until(timeout_s, [&] { return !runs(); });
}

std::string Child::text_of(std::FILE* file) {
  std::string text;
  char bytes[4096];
  // The child shares the file's position: it must not move.
  for (ssize_t n; (n = pread(fileno(file), bytes, sizeof bytes, off_t(text.size()))) > 0;)
    text.append(bytes, size_t(n));
  return text;
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace izb::test

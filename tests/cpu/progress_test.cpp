// SPDX-License-Identifier: MIT
#include "base/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <thread>
#include <vector>

#include "base/file.h"

namespace {

using namespace std::chrono_literals;

/// A pseudo-terminal: what is written to `terminal` can be read from `reader`.
struct PseudoTerminal {
  int reader = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  std::FILE* terminal = nullptr;
  PseudoTerminal() {
    if (reader >= 0 && grantpt(reader) == 0 && unlockpt(reader) == 0) terminal = std::fopen(ptsname(reader), "w");
  }
  ~PseudoTerminal() {
    if (terminal) std::fclose(terminal);
    if (reader >= 0) close(reader);
  }
  std::string text() const {
    std::string all;
    char bytes[4096];
    for (ssize_t n; (n = read(reader, bytes, sizeof bytes)) > 0;) all.append(bytes, size_t(n));
    return all;
  }
};

TEST(Progress, AppearsAfterASecondAndClearsItsLine) {
  const PseudoTerminal pty;
  if (!pty.terminal) GTEST_SKIP() << "no pseudo-terminal";
  {
    izb::Progress progress("rays", 400, pty.terminal);
    progress.advance(50);
    EXPECT_EQ(pty.text(), "");
    std::this_thread::sleep_for(1050ms);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 12; ++k) progress.advance(1);
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_NE(pty.text().find("\rrays: [##------------------] 1"), std::string::npos);
    std::this_thread::sleep_for(150ms);
    progress.advance(2);
    EXPECT_EQ(pty.text(), "\rrays: [#####---------------] 25 %\x1b[K");
  }
  EXPECT_EQ(pty.text(), "\r\x1b[K");
}

TEST(Progress, IsDrawnWithoutAnyAdvance) {
  const PseudoTerminal pty;
  if (!pty.terminal) GTEST_SKIP() << "no pseudo-terminal";
  {
    izb::Progress load("loading", 0, pty.terminal), trace("tracing", 4, pty.terminal);
    trace.relabel("settling");
    std::this_thread::sleep_for(1300ms);
    const std::string text = pty.text();
    EXPECT_NE(text.find("\rloading: 1 s"), std::string::npos) << text;
    EXPECT_NE(text.find("\rsettling: [--------------------] 0 %"), std::string::npos) << text;
    std::this_thread::sleep_for(1000ms);
    EXPECT_NE(pty.text().find("\rloading: 2 s"), std::string::npos);
  }
}

TEST(Progress, IsSilentOnShortWork) {
  const PseudoTerminal pty;
  if (!pty.terminal) GTEST_SKIP() << "no pseudo-terminal";
  { izb::Progress("rays", 1, pty.terminal).advance(); }
  EXPECT_EQ(pty.text(), "");
}

TEST(Progress, IsSilentWhereThereIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    izb::Progress progress("rays", 2, file);
    std::this_thread::sleep_for(1050ms);
    progress.advance();
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace

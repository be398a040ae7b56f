// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <set>

#include "base/error.h"
#include "full_device.h"

namespace {

namespace fs = std::filesystem;

struct Files : testing::Test {
  const fs::path folder = fs::path(testing::TempDir()) / ("izb_file_test_" + std::to_string(getpid()));
  Files() { fs::create_directories(folder); }
  ~Files() override { fs::remove_all(folder); }

  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.insert(entry.path().filename());
    return found;
  }
};

/// The message of the izb::Error that `action` throws, or "" if it throws none.
template <typename Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const izb::Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(Files, KeepAllBytes) {
  std::string text(300000, 'x');
  for (size_t i = 0; i < text.size(); ++i) text[i] = char(i * 7);
  izb::write_file_atomically(folder / "a", text);
  EXPECT_EQ(izb::read_text_file(folder / "a"), text);
  const std::vector<std::byte> bytes = izb::read_binary_file(folder / "a");
  ASSERT_EQ(bytes.size(), text.size());
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), std::as_bytes(std::span(text)).begin()));
  izb::write_file_atomically(folder / "a", std::string_view());
  EXPECT_TRUE(izb::read_binary_file(folder / "a").empty());
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(Files, ReadsWhatHasNoSize) {
  EXPECT_NE(izb::read_text_file("/proc/self/status").find("Pid:"), std::string::npos);
}

TEST_F(Files, ReadingFailsInOneSentence) {
  const std::string missing = (folder / "missing").string();
  EXPECT_EQ(error_of([&] { izb::read_text_file(missing); }),
            "cannot read '" + missing + "': No such file or directory");
  EXPECT_EQ(error_of([&] { izb::read_binary_file(folder); }),
            "cannot read '" + folder.string() + "': it is a directory");
  EXPECT_EQ(error_of([&] { izb::read_text_file("/dev/zero"); }), "cannot read '/dev/zero': it is a device");
}

TEST_F(Files, WritingFailsInOneSentence) {
  const std::string absent = (folder / "absent" / "a").string();
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(absent, std::string_view("x")); }),
            "cannot write '" + absent + "': the folder '" + (folder / "absent").string() + "' does not exist");
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(folder, std::string_view("x")); }),
            "cannot write '" + folder.string() + "': it is a directory");
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(folder / "", std::string_view("x")); }),
            "cannot write '" + (folder / "").string() + "': it is a directory");

  izb::write_file_atomically(folder / "file", std::string_view("old"));
  const std::string below = (folder / "file" / "a").string();
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(below, std::string_view("x")); }),
            "cannot write '" + below + "': Not a directory");
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

TEST_F(Files, AFullDeviceIsAnErrorAndStays) {
  const auto full = full_device(folder);
  if (!full) GTEST_SKIP() << "no full device";
  const std::string expected = "cannot write '" + full->string() + "': No space left on device";
  // Few bytes fail when closing, many when writing.
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(*full, std::string_view("x")); }), expected);
  ASSERT_TRUE(fs::is_character_file(*full));
  EXPECT_EQ(error_of([&] { izb::write_file_atomically(*full, std::string(1 << 20, 'x')); }), expected);
  EXPECT_TRUE(fs::is_character_file(*full));

  fs::create_symlink(*full, folder / "link");
  EXPECT_NE(error_of([&] { izb::write_file_atomically(folder / "link", std::string_view("x")); }), "");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

/// While it lives, no file of this process grows beyond `bytes`: a full disk, for regular files.
struct FileSizeLimit {
  rlimit before{};
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
  }
};

TEST_F(Files, AFullDiskLeavesTheOldFileAndNothingElse) {
  izb::write_file_atomically(folder / "a", std::string_view("old"));
  const std::string expected = "cannot write '" + (folder / "a").string() + "': File too large";
  std::string few_bytes, many_bytes;
  {
    const FileSizeLimit limit(100);
    few_bytes = error_of([&] { izb::write_file_atomically(folder / "a", std::string(200, 'x')); });
    many_bytes = error_of([&] { izb::write_file_atomically(folder / "a", std::string(1 << 20, 'x')); });
  }
  EXPECT_EQ(few_bytes, expected);
  EXPECT_EQ(many_bytes, expected);
  EXPECT_EQ(izb::read_text_file(folder / "a"), "old");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(Files, PipesAndDevicesAreWrittenNotReplaced) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  izb::write_file_atomically(pipe, std::string_view("abc"));
  char bytes[8] = {};
  EXPECT_EQ(read(reader, bytes, sizeof bytes), 3);
  close(reader);
  EXPECT_EQ(std::string(bytes), "abc");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Files, AnOldFileStaysUntilTheNewOneIsWhole) {
  izb::write_file_atomically(folder / "a", std::string_view("old"));
  {
    izb::AtomicFile file(folder / "a");
    file.write(std::as_bytes(std::span(std::string_view("half of the new"))));
    EXPECT_EQ(izb::read_text_file(folder / "a"), "old");
  }
  EXPECT_EQ(izb::read_text_file(folder / "a"), "old");
  EXPECT_EQ(names(), std::set<std::string>{"a"});

  izb::AtomicFile file(folder / "a");
  file.write(std::as_bytes(std::span(std::string_view("new"))));
  file.commit();
  EXPECT_EQ(izb::read_text_file(folder / "a"), "new");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(Files, AreReadableByOthersAsTheUmaskSays) {
  const mode_t old_mask = umask(022);
  izb::write_file_atomically(folder / "a", std::string_view("x"));
  umask(old_mask);
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0644));
}

TEST_F(Files, SymbolicLinksAreFollowed) {
  izb::write_file_atomically(folder / "a", std::string_view("old"));
  fs::create_symlink(folder / "a", folder / "link");
  izb::write_file_atomically(folder / "link", std::string_view("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(izb::read_text_file(folder / "a"), "new");
}

TEST_F(Files, WhatKilledProcessesLeftCanBeRemoved) {
  // One has ended and is not waited for yet, another runs, a third is gone.
  const auto start = [](bool ends) {
    const pid_t child = fork();
    if (child == 0) {
      if (!ends) pause();
      _exit(0);
    }
    return child;
  };
  const pid_t zombie = start(true), running = start(false), gone = start(true);
  waitpid(gone, nullptr, 0);
  siginfo_t ended;
  waitid(P_PID, static_cast<id_t>(zombie), &ended, WEXITED | WNOWAIT);
  const auto name_of = [](pid_t process) { return ".izb-" + std::to_string(process) + "-0.tmp"; };
  std::set<std::string> stay{
      "a", ".izb-x-0.tmp", ".izb-0-0.tmp", name_of(gone) + "x", name_of(running), name_of(getpid())};
  for (const std::string& name : stay) izb::write_file_atomically(folder / name, std::string_view("x"));
  for (const pid_t process : {zombie, gone})
    izb::write_file_atomically(folder / name_of(process), std::string_view("x"));
  izb::remove_stale_temporaries(folder);
  EXPECT_EQ(names(), stay);
  kill(running, SIGKILL);
  waitpid(running, nullptr, 0);
  waitpid(zombie, nullptr, 0);
  izb::remove_stale_temporaries(folder / "nonesuch");
}

TEST_F(Files, ANameWithoutAFolderIsInTheCurrentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  izb::write_file_atomically("plain", std::string_view("x"));
  fs::current_path(before);
  EXPECT_EQ(izb::read_text_file(folder / "plain"), "x");
}

}  // namespace

// SPDX-License-Identifier: MIT
#include "base/machine_memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "cpu/gltf_writer.h"

namespace {

namespace fs = std::filesystem;
using izb::available_main_memory;

struct MachineMemory : testing::Test {
  const izb::test::TemporaryFolder folder;

  void write(const fs::path& path, const std::string& text) const {
    const fs::path file = folder / path;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  uint64_t available() const { return available_main_memory(folder / ".").value_or(0); }
};

TEST_F(MachineMemory, IsUnknownWhereTheSystemDoesNotSay) {
  EXPECT_FALSE(available_main_memory(folder / ".").has_value());
}

TEST_F(MachineMemory, OfTheMachine) {
  write("proc/meminfo", "MemTotal: 9000 kB\nMemFree: 10 kB\nMemAvailable:   5000 kB\n");
  EXPECT_EQ(available(), 5000u * 1024u);
}

TEST_F(MachineMemory, TheTightestGroupCounts) {
  write("proc/meminfo", "MemAvailable: 5000 kB\n");
  write("proc/self/cgroup", "0::/outer/inner\n");
  write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  write("sys/fs/cgroup/outer/inner/memory.current", "1000000\n");
  write("sys/fs/cgroup/outer/memory.max", "2000000\n");
  write("sys/fs/cgroup/outer/memory.current", "1500000\n");
  write("sys/fs/cgroup/outer/memory.stat", "anon 1100000\ninactive_file 300000\nactive_file 100000\n");
  EXPECT_EQ(available(), 2000000u - 1100000u);  // cached files make room
  write("sys/fs/cgroup/outer/memory.current", "9000000\n");
  EXPECT_EQ(available(), 0u);
}

TEST_F(MachineMemory, OfVersionOneAndAGroupSeenAsTheRoot) {
  write("proc/meminfo", "MemAvailable: 5000 kB\n");
  write("proc/self/cgroup", "9:name=systemd:/elsewhere\n4:memory:/hidden/from/here\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "3000000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000000\n");
  write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 200000\ntotal_active_file 100000\n");
  EXPECT_EQ(available(), 3000000u - 700000u);
}

TEST(ProcessMemory, OfWhatWasFreedGoesBack) {
#if !defined(__GLIBC__) || defined(IZB_SANITIZED)
  GTEST_SKIP() << "another allocator";
#endif
  // Small enough for the C library to keep them, with something behind each that stays.
  std::vector<std::vector<char>> blocks, staying;
  for (int i = 0; i < 2000; ++i) {
    blocks.emplace_back(100000, 'x');
    staying.emplace_back(2000, 'x');
  }
  blocks.clear();
  const uint64_t kept = izb::process_memory().value();
  izb::give_back_freed_memory();
  EXPECT_LT(izb::process_memory().value() + 150'000'000, kept);
}

}  // namespace

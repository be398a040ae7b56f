// SPDX-License-Identifier: MIT
// How much main memory this process could still take.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

namespace izb {

/// The least of what the machine has available and what each control group of this process has left, in bytes; nothing
/// where the system does not say. `root`: where /proc and /sys are looked for, for tests.
std::optional<uint64_t> available_main_memory(const std::filesystem::path& root = "/");

/// What this process holds now, in bytes; nothing where the system does not say.
std::optional<uint64_t> process_memory();

/// The most that this process has held so far, in bytes; nothing where the system does not say.
std::optional<uint64_t> peak_process_memory();

}  // namespace izb

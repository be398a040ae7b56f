// SPDX-License-Identifier: MIT
// The main memory of this process: what it holds, and how much more it could take.
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

/// What was freed goes back to the system, where the C library keeps it otherwise: glibc's arenas hold blocks of up to
/// 32 MiB for the next who asks.
void give_back_freed_memory();

}  // namespace izb

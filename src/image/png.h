// SPDX-License-Identifier: MIT
// PNG in and out: pictures to look at.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "image/image.h"

namespace izb {

class AtomicFile;

/// Writes an sRGB picture of 3 or 4 components atomically. Throws izb::Error if the file cannot be written.
void write_png(const std::filesystem::path& path, const Image8& picture);

/// The same into an open file, without its commit().
void write_png(AtomicFile& file, const Image8& picture);

/// Reads any PNG as 8-bit sRGB: 4 components if it has alpha, else 3. Throws izb::Error if the file is
/// missing, is no PNG, or is truncated.
Image8 read_png(const std::filesystem::path& path);

/// The same from the bytes of a file; `name` is for messages.
Image8 read_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace izb

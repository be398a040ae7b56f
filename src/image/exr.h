// SPDX-License-Identifier: MIT
// OpenEXR in and out.
//
// Two standard attributes let another program render the same frame; their spaces are OpenEXR's, not
// OpenGL's:
//   worldToCamera  left-handed camera space: x right, y up, +z along the view (an OpenGL view matrix with z
//   negated); worldToNDC     x right, y DOWN, (0, 0) and (1, 1) at the upper left and lower right corners of
//   the picture.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "image/image.h"

namespace izb {

class AtomicFile;

struct ExrOptions {
  bool half_color =
      false;  ///< store the channels R, G, B and A in 16 bits; finite values are clamped to the half's range
};

/// Writes all channels (FLOAT and UINT, ZIP-compressed in blocks of 16 rows on all cores) and attributes,
/// atomically. Throws izb::Error if the file cannot be written, or if OpenEXR refuses the size, a channel or
/// an attribute.
void write_exr(const std::filesystem::path& path, const Image& image, const ExrOptions& options = {});

/// The same into an open file, without its commit().
void write_exr(AtomicFile& file, const Image& image, const ExrOptions& options = {});

/// Reads the first part of a flat OpenEXR file: all channels in order of their names (half becomes float) and
/// the attributes of the types in Attribute, but for those that OpenEXR itself requires of each file. Throws
/// izb::Error if the file is missing, is no OpenEXR file, is truncated, or has subsampled channels.
Image read_exr(const std::filesystem::path& path);

/// The same from the bytes of a file; `name` is for messages.
Image read_exr(std::span<const std::byte> bytes, const std::string& name);

/// Its attributes alone, without reading the pixels.
std::map<std::string, Attribute> read_exr_attributes(const std::filesystem::path& path);

}  // namespace izb

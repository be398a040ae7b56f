// SPDX-License-Identifier: MIT
#include "frame/geometry_windows.h"

#include <algorithm>

#include "base/error.h"
#include "shared/bindings.h"

namespace izb {
namespace {

/// So that windows begin where every driver lets them (multiples of 256 bytes) and no position is cut.
constexpr uint64_t words_granularity = 64 * 3;

int windows_of(const char* what, uint64_t bytes, uint64_t window_bytes) {
  const uint64_t count = std::max<uint64_t>((bytes + window_bytes - 1) / window_bytes, 1);
  if (count > MAX_GEOMETRY_WINDOWS)
    fail("the scene's {} take {} bytes, and this GL driver's storage blocks, {} of them, end at {}", what, bytes,
         MAX_GEOMETRY_WINDOWS, MAX_GEOMETRY_WINDOWS * window_bytes);
  return static_cast<int>(count);
}

}  // namespace

GeometryWindows::GeometryWindows(uint64_t position_bytes, uint64_t index_bytes, const gpu::Capabilities& capabilities) {
  const auto limit = std::min<uint64_t>(static_cast<uint64_t>(capabilities.max_storage_block_bytes), 1u << 31);
  const uint64_t whole = std::max<uint64_t>(limit / sizeof(uint32_t) / words_granularity, 1) * words_granularity;
  words = static_cast<uint32_t>(whole);
  positions = windows_of("positions", position_bytes, whole * sizeof(uint32_t));
  indices = windows_of("indices", index_bytes, whole * sizeof(uint32_t));
}

gpu::Defines GeometryWindows::defines() const {
  gpu::Defines all;
  if (positions > 1) all["POSITION_WINDOWS"] = std::to_string(positions);
  if (indices > 1) all["INDEX_WINDOWS"] = std::to_string(indices);
  if (!all.empty()) all["WINDOW_WORDS"] = std::to_string(words) + "u";
  return all;
}

void GeometryWindows::bind(GLuint first, GLuint more, const gpu::Buffer& buffer, int count) const {
  if (count == 1) return glBindBufferBase(GL_SHADER_STORAGE_BUFFER, first, buffer.name());
  const size_t window_bytes = size_t(words) * sizeof(uint32_t);
  for (int k = 0; k < count; ++k) {
    const size_t offset_bytes = static_cast<size_t>(k) * window_bytes;
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, k == 0 ? first : more + static_cast<GLuint>(k - 1), buffer.name(),
                      static_cast<GLintptr>(offset_bytes),
                      static_cast<GLsizeiptr>(std::min(window_bytes, buffer.bytes() - offset_bytes)));
  }
}

}  // namespace izb

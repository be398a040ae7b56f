// SPDX-License-Identifier: MIT
// GPU memory before it is taken: what is planned, what there is, and a sentence where the one exceeds the other.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/capabilities.h"
#include "gpu/gl.h"

namespace izb::gpu {

/// A texture or a buffer that will be made.
struct Planned {
  enum class Kind { texture, storage_buffer, buffer_texture, other_buffer };
  std::string part;  ///< what it belongs to, e.g. "nodes"
  Kind kind = Kind::texture;
  uint64_t bytes = 0;
  std::vector<std::string> reduce;  ///< the options that make it smaller, e.g. "--grid"
  GLenum format = 0;                ///< this and the rest: of a texture
  int width_px = 0, height_px = 0, layers = 1, levels = 1;
  uint64_t texels = 0;  ///< of a buffer texture
};

Planned planned_texture(std::string part, GLenum format, int width_px, int height_px, std::vector<std::string> reduce,
                        int layers = 1, int levels = 1);
Planned planned_buffer(std::string part, Planned::Kind kind, uint64_t bytes, std::vector<std::string> reduce);
/// Of GL_R32UI, GL_R8UI or GL_RG32F.
Planned planned_buffer_texture(std::string part, GLenum format, uint64_t texels, std::vector<std::string> reduce);

using Plan = std::vector<Planned>;
/// Plans by the name of the group that they belong to, e.g. "gbuffer".
using Plans = std::vector<std::pair<std::string, Plan>>;

uint64_t bytes_of(const Plan& plan);

/// What the process could take in all.
struct Room {
  std::optional<uint64_t> bytes;  ///< nothing: unknown
  std::string where;              ///< e.g. "this machine"
};

/// Of a software renderer: main memory; of a GPU: what its driver says, if it does. `held_bytes` are taken already and
/// count as room. $IZB_MEMORY_BYTES, for tests, takes the place of it all.
Room memory_room(const Capabilities& capabilities, uint64_t held_bytes = 0);

/// Throws izb::Error, one sentence with the options that would help, if the plans together do not fit in the room, or
/// one of their objects is beyond the driver's limits.
void expect_room(const Plans& plans, const Room& room, const Capabilities& capabilities);

/// "70.1 MB", 1 MB being 10^6 bytes.
std::string megabytes(uint64_t bytes);
/// "izb 70.1 MB, gbuffer 82.9 MB".
std::string describe(const std::vector<std::pair<std::string, uint64_t>>& groups);

}  // namespace izb::gpu

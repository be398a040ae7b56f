// SPDX-License-Identifier: MIT
// What the driver is and what it can do, asked once.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace izb::gpu {

struct Capabilities {
  std::string vendor, renderer, version, glsl_version;
  bool software = false;  ///< a CPU renderer: its timer queries miss work, so stages are timed by the wall clock
  int64_t max_texture_size = 0;
  int64_t max_texture_layers = 0;
  int64_t max_buffer_texels = 0;
  int64_t max_storage_block_bytes = 0;
  int64_t max_vertex_storage_blocks = 0;
  int64_t subpixel_bits = 0;
  std::vector<std::string> extensions;
  /// By how many pixels GL_NV_conservative_raster_dilate can dilate, and in what steps; 0 without it.
  float raster_dilation_px = 0, raster_dilation_step_px = 0;

  bool has(const std::string& extension) const;
};

/// Asks the current context.
Capabilities query_capabilities();

/// Names and values of the limits and extensions that matter to izb, for `izb info`.
std::vector<std::pair<std::string, std::string>> describe(const Capabilities& capabilities);

/// Turns GL errors and high-severity messages into a count and a note on stderr (KHR_debug).
void enable_debug_messages();
/// Errors and high-severity messages since enable_debug_messages().
int debug_message_count();

}  // namespace izb::gpu

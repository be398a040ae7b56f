// SPDX-License-Identifier: MIT
#include "gpu/capabilities.h"

#include <algorithm>
#include <atomic>

#include "base/log.h"
#include "gpu/gl.h"

namespace izb::gpu {
namespace {

std::atomic<int> message_count{0};

void APIENTRY on_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void*) {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  ++message_count;
  warn("GL: {}", text);
}

std::string string_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

int64_t integer_of(GLenum name) {
  GLint64 value = 0;
  glGetInteger64v(name, &value);
  return value;
}

}  // namespace

bool Capabilities::has(const std::string& extension) const {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

Capabilities query_capabilities() {
  Capabilities c;
  c.vendor = string_of(GL_VENDOR);
  c.renderer = string_of(GL_RENDERER);
  c.version = string_of(GL_VERSION);
  c.glsl_version = string_of(GL_SHADING_LANGUAGE_VERSION);
  for (const char* name : {"llvmpipe", "softpipe", "SWR", "Software", "software"})
    c.software |= c.renderer.find(name) != std::string::npos;
  c.max_texture_size = integer_of(GL_MAX_TEXTURE_SIZE);
  c.max_texture_layers = integer_of(GL_MAX_ARRAY_TEXTURE_LAYERS);
  c.max_buffer_texels = integer_of(GL_MAX_TEXTURE_BUFFER_SIZE);
  c.max_storage_block_bytes = integer_of(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  c.max_vertex_storage_blocks = integer_of(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS);
  c.subpixel_bits = integer_of(GL_SUBPIXEL_BITS);
  const int64_t count = integer_of(GL_NUM_EXTENSIONS);
  for (int64_t i = 0; i < count; ++i)
    c.extensions.emplace_back(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
  if (c.has("GL_NV_conservative_raster_dilate")) {
    float range[2] = {};
    glGetFloatv(GL_CONSERVATIVE_RASTER_DILATE_RANGE_NV, range);
    glGetFloatv(GL_CONSERVATIVE_RASTER_DILATE_GRANULARITY_NV, &c.raster_dilation_step_px);
    c.raster_dilation_px = range[1];
  }
  return c;
}

std::vector<std::pair<std::string, std::string>> describe(const Capabilities& c) {
  std::vector<std::pair<std::string, std::string>> rows{
      {"vendor", c.vendor},
      {"renderer", c.renderer},
      {"version", c.version},
      {"GLSL", c.glsl_version},
      {"stage times", c.software ? "wall clock (software renderer)" : "timer queries"},
      {"GL_MAX_TEXTURE_SIZE", fmt::format("{}", c.max_texture_size)},
      {"GL_MAX_ARRAY_TEXTURE_LAYERS", fmt::format("{}", c.max_texture_layers)},
      {"GL_MAX_TEXTURE_BUFFER_SIZE", fmt::format("{} texels", c.max_buffer_texels)},
      {"GL_MAX_SHADER_STORAGE_BLOCK_SIZE", fmt::format("{} bytes", c.max_storage_block_bytes)},
      {"GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS", fmt::format("{}", c.max_vertex_storage_blocks)},
      {"GL_SUBPIXEL_BITS", fmt::format("{}", c.subpixel_bits)}};
  for (const char* name : {"GL_NV_conservative_raster", "GL_NV_conservative_raster_dilate",
                           "GL_NV_geometry_shader_passthrough", "GL_INTEL_conservative_rasterization"})
    rows.emplace_back(name, c.has(name) ? "yes" : "no");
  return rows;
}

void enable_debug_messages() {
  message_count = 0;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, nullptr);
}

int debug_message_count() {
  return message_count;
}

}  // namespace izb::gpu

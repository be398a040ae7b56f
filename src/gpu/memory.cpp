// SPDX-License-Identifier: MIT
#include "gpu/memory.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "base/error.h"
#include "base/machine_memory.h"
#include "gpu/objects.h"

namespace izb::gpu {
namespace {

// GL_NVX_gpu_memory_info and GL_ATI_meminfo are not in the core header. Both count in KiB.
constexpr GLenum free_on_nvidia = 0x9049, free_on_amd = 0x87FC;

/// "--size, --grid or --nodes".
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

std::string advice(const std::vector<std::string>& reduce) {
  return reduce.empty() ? "take a smaller scene" : "reduce " + alternatives(reduce);
}

/// Every option that makes one of the plans smaller, that of the largest first.
std::vector<std::string> all_options(const Plans& plans) {
  std::vector<const Planned*> sorted;
  for (const auto& [group, plan] : plans)
    for (const Planned& p : plan) sorted.push_back(&p);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Planned* a, const Planned* b) { return a->bytes > b->bytes; });
  std::vector<std::string> options;
  for (const Planned* p : sorted)
    for (const std::string& option : p->reduce)
      if (std::find(options.begin(), options.end(), option) == options.end()) options.push_back(option);
  return options;
}

/// Whether the driver would take it: it may have limits on the whole beside those on each side.
bool driver_takes(const Planned& p) {
  const GLenum target = p.layers > 1 ? GL_PROXY_TEXTURE_2D_ARRAY : GL_PROXY_TEXTURE_2D;
  if (p.layers > 1)
    glTexStorage3D(target, p.levels, p.format, p.width_px, p.height_px, p.layers);
  else
    glTexStorage2D(target, p.levels, p.format, p.width_px, p.height_px);
  GLint width_px = 0;
  glGetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &width_px);
  return width_px == p.width_px;
}

void expect_within_limits(const std::string& group, const Planned& p, const Capabilities& c) {
  const auto refuse = [&](const std::string& limit) {
    const std::string shape = p.kind == Planned::Kind::texture
                                  ? fmt::format("a texture of {} x {} x {}", p.width_px, p.height_px, p.layers)
                                  : std::string("a buffer");
    fail("{} needs {} ({}) for '{}', but {}: {}", group, shape, megabytes(p.bytes), p.part, limit, advice(p.reduce));
  };
  switch (p.kind) {
    case Planned::Kind::texture:
      if (std::max(p.width_px, p.height_px) > c.max_texture_size)
        refuse(fmt::format("this GL driver's largest is {} a side", c.max_texture_size));
      if (p.layers > c.max_texture_layers)
        refuse(fmt::format("this GL driver stops at {} layers", c.max_texture_layers));
      if (!driver_takes(p)) refuse("this GL driver refuses it as too large");
      break;
    case Planned::Kind::storage_buffer:
      if (p.bytes > static_cast<uint64_t>(c.max_storage_block_bytes))
        refuse(fmt::format("this GL driver's storage buffers stop at {}",
                           megabytes(static_cast<uint64_t>(c.max_storage_block_bytes))));
      break;
    case Planned::Kind::buffer_texture:
      if (p.texels > static_cast<uint64_t>(c.max_buffer_texels))
        refuse(fmt::format("this GL driver's buffer textures stop at {} texels", c.max_buffer_texels));
      break;
    case Planned::Kind::other_buffer:
      break;
  }
}

}  // namespace

Planned planned_texture(std::string part, GLenum format, int width_px, int height_px, std::vector<std::string> reduce,
                        int layers, int levels) {
  return {std::move(part),
          Planned::Kind::texture,
          texture_bytes(format, width_px, height_px, layers, levels),
          std::move(reduce),
          format,
          width_px,
          height_px,
          layers,
          levels};
}

Planned planned_buffer(std::string part, Planned::Kind kind, uint64_t bytes, std::vector<std::string> reduce) {
  Planned p;
  p.part = std::move(part);
  p.kind = kind;
  p.bytes = buffer_bytes(bytes);
  if (kind == Planned::Kind::buffer_texture) p.texels = p.bytes / sizeof(uint32_t);
  p.reduce = std::move(reduce);
  return p;
}

Planned planned_buffer_texture(std::string part, GLenum format, uint64_t texels, std::vector<std::string> reduce) {
  const uint64_t texel_bytes = format == GL_R8UI ? 1 : format == GL_RG32F ? 8 : 4;
  Planned p = planned_buffer(std::move(part), Planned::Kind::buffer_texture, texels * texel_bytes, std::move(reduce));
  p.format = format;
  p.texels = texels;
  return p;
}

uint64_t bytes_of(const Plan& plan) {
  uint64_t sum = 0;
  for (const Planned& p : plan) sum += p.bytes;
  return sum;
}

Room memory_room(const Capabilities& capabilities, uint64_t held_bytes) {
  if (const char* text = std::getenv("IZB_MEMORY_BYTES")) {
    uint64_t bytes = 0;
    const char* const end = text + std::strlen(text);
    if (const auto [after, error] = std::from_chars(text, end, bytes); error != std::errc() || after != end)
      fail("IZB_MEMORY_BYTES must be a number of bytes, not '{}'", text);
    return {bytes, "IZB_MEMORY_BYTES"};
  }
  const auto with_held = [&](uint64_t bytes) { return bytes + held_bytes; };
  if (capabilities.software) {
    const std::optional<uint64_t> free = available_main_memory();
    return {free ? std::optional(with_held(*free)) : std::nullopt, "this machine"};
  }
  GLint kibibytes[4] = {};
  if (capabilities.has("GL_NVX_gpu_memory_info"))
    glGetIntegerv(free_on_nvidia, kibibytes);
  else if (capabilities.has("GL_ATI_meminfo"))
    glGetIntegerv(free_on_amd, kibibytes);
  else
    return {std::nullopt, "this GPU"};
  return {with_held(uint64_t{1024} * static_cast<uint32_t>(kibibytes[0])), "this GPU"};
}

void expect_room(const Plans& plans, const Room& room, const Capabilities& capabilities) {
  std::vector<std::pair<std::string, uint64_t>> groups;
  uint64_t sum = 0;
  for (const auto& [group, plan] : plans) {
    groups.emplace_back(group, bytes_of(plan));
    sum += groups.back().second;
  }
  if (room.bytes && sum > *room.bytes)
    fail("not enough memory: {} are needed ({}), and {} has {} left: {}", megabytes(sum), describe(groups), room.where,
         megabytes(*room.bytes), advice(all_options(plans)));
  for (const auto& [group, plan] : plans)
    for (const Planned& p : plan) expect_within_limits(group, p, capabilities);
}

std::string megabytes(uint64_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}

std::string describe(const std::vector<std::pair<std::string, uint64_t>>& groups) {
  std::string text;
  for (const auto& [name, bytes] : groups) text += (text.empty() ? "" : ", ") + name + " " + megabytes(bytes);
  return text;
}

}  // namespace izb::gpu

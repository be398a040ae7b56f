// SPDX-License-Identifier: MIT
#include "scene/gltf_document.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb_image.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "scene/gltf_check.h"
#include "scene/gltf_compression.h"
#include "scene/gltf_uri.h"

namespace izb {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;
using nlohmann::json;

constexpr size_t whole_file = static_cast<size_t>(-1);

/// The first `limit` bytes of a file. Throws izb::Error with the cause.
Bytes read_bytes(const fs::path& path, size_t limit = whole_file, const std::function<void(double)>& read = {}) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail("there is no such file");
  if (status.type() == fs::file_type::none) fail("it cannot be opened ({})", error.message());
  if (fs::is_directory(status)) fail("it is a directory");
  if (!fs::is_regular_file(status)) fail("it is not a regular file");
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail("it cannot be opened ({})", std::strerror(errno));
  const uintmax_t size = fs::file_size(path, error);
  if (error) fail("its size cannot be read ({})", error.message());
  Bytes bytes(std::min<uintmax_t>(size, limit));
  constexpr size_t step = size_t(16) << 20;
  for (size_t at = 0; at < bytes.size(); at += step) {
    const size_t count = std::min(step, bytes.size() - at);
    if (std::fread(bytes.data() + at, 1, count, file.get()) != count)
      fail("it cannot be read ({})", std::strerror(errno));
    if (read) read(double(at + count) / double(bytes.size()));
  }
  return bytes;
}

uint32_t little_endian_u32(const unsigned char* p) {
  return uint32_t(p[0]) | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
}

bool is_glb(const Bytes& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON text of a GLB (glTF 2.0, section 4.4), after checks that all chunks lie within the file.
std::string_view glb_json(const Bytes& bytes) {
  constexpr size_t header_size = 12, chunk_header_size = 8;
  if (bytes.size() < header_size + chunk_header_size) fail("the GLB is truncated ({} bytes)", bytes.size());
  const uint32_t version = little_endian_u32(&bytes[4]), length = little_endian_u32(&bytes[8]);
  if (version != 2) fail("it is a GLB of version {}, and only version 2 is read", version);
  if (length > bytes.size()) fail("the GLB is truncated: it should have {} bytes and has {}", length, bytes.size());
  const size_t json_length = little_endian_u32(&bytes[12]);
  if (std::memcmp(&bytes[16], "JSON", 4) != 0) fail("the GLB's first chunk is not JSON");
  const size_t json_begin = header_size + chunk_header_size, json_end = json_begin + json_length;
  if (json_end > length) fail("the GLB's JSON chunk is longer than the file");
  if (json_end != length) {
    if (json_end + chunk_header_size > length) fail("the GLB's second chunk is truncated");
    if (json_end + chunk_header_size + little_endian_u32(&bytes[json_end]) > length)
      fail("the GLB's second chunk is longer than the file");
  }
  return {reinterpret_cast<const char*>(&bytes[json_begin]), json_length};
}

/// The same GLB with another JSON text.
Bytes glb_with_json(const Bytes& bytes, std::string text) {
  constexpr size_t header_size = 12, chunk_header_size = 8;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const size_t rest_begin = header_size + chunk_header_size + little_endian_u32(&bytes[12]);
  const size_t length = little_endian_u32(&bytes[8]);
  Bytes out(bytes.begin(), bytes.begin() + header_size + chunk_header_size);
  out.insert(out.end(), text.begin(), text.end());
  out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(rest_begin),
             bytes.begin() + static_cast<std::ptrdiff_t>(length));
  const auto put_u32 = [&](size_t at, size_t value) {
    for (size_t k = 0; k < 4; ++k) out[at + k] = static_cast<unsigned char>(value >> (8 * k));
  };
  put_u32(8, out.size());
  put_u32(12, text.size());
  return out;
}

/// tinygltf walks nested values recursively, so a hostile depth would overflow its stack.
void check_nesting(std::string_view text) {
  constexpr int limit = 256;
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > limit) fail("its JSON is nested deeper than {} levels", limit);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

json parse_json(std::string_view text, bool glb) {
  check_nesting(text);
  try {
    return json::parse(text);
  } catch (const json::parse_error& e) {
    if (glb) fail("the GLB's JSON has an error at byte {}", e.byte);
    fail("it is neither a GLB nor JSON (error at byte {})", e.byte);
  } catch (const json::exception&) {
    fail("its JSON holds a number that is out of range");
  }
}

/// What tinygltf may read while it parses: exactly the files and images that the scene shows.
struct Resources {
  std::map<std::string, size_t> files;       ///< normalised path → how many bytes of it are needed
  std::set<int> images;                      ///< images that a base colour uses
  std::map<int, std::string> broken_images;  ///< image → why it was not decoded

  static std::string key(const fs::path& path) { return path.lexically_normal().string(); }
};

void add_buffer_files(const json& root, const fs::path& folder, Resources& resources) {
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return;
  for (size_t i = 0; i < buffers->size(); ++i) {
    const json& buffer = (*buffers)[i];
    const auto uri = buffer.value("uri", std::string());
    if (uri.empty() || tinygltf::IsDataURI(uri)) continue;
    if (uri.starts_with("data:")) fail("buffers[{}] is a data URI of a kind that is not supported", i);
    const fs::path file = folder / percent_decoded(uri);
    const auto length = buffer["byteLength"].get<size_t>();
    std::error_code error;
    if (!fs::is_regular_file(file, error)) fail("its buffer file '{}' is missing", file.string());
    const uintmax_t size = fs::file_size(file, error);
    if (error || size < length)
      fail("its buffer file '{}' has {} bytes, but {} are needed", file.string(), size, length);
    size_t& needed = resources.files[Resources::key(file)];
    needed = std::max(needed, length);
  }
}

void add_images(const json& root, const fs::path& folder, Resources& resources) {
  for (const json& material : root.value("materials", json::array())) {
    const json::json_pointer to_index("/pbrMetallicRoughness/baseColorTexture/index");
    if (!material.contains(to_index)) continue;
    const json& texture = root["textures"][material[to_index].get<size_t>()];
    if (!texture.contains("source")) continue;
    const int image = texture["source"];
    resources.images.insert(image);
    const auto uri = root["images"][static_cast<size_t>(image)].value("uri", std::string());
    if (!uri.empty() && !uri.starts_with("data:"))
      resources.files[Resources::key(folder / percent_decoded(uri))] = whole_file;
  }
}

bool resource_exists(const std::string& path, void* user) {
  return static_cast<Resources*>(user)->files.contains(Resources::key(path)) && fs::is_regular_file(path);
}

bool read_resource(Bytes* bytes, std::string* error, const std::string& path, void* user) {
  try {
    *bytes = read_bytes(path, static_cast<Resources*>(user)->files.at(Resources::key(path)));
    return true;
  } catch (const Error& e) {
    *error = e.what();
    return false;
  }
}

bool decode_image(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void* user) {
  auto& resources = *static_cast<Resources*>(user);
  if (!resources.images.contains(index)) return true;
  int width_px = 0, height_px = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes, size, &width_px, &height_px, &channels, 4), &stbi_image_free);
  if (!pixels) {
    resources.broken_images[index] = stbi_failure_reason();
    return true;
  }
  image->width = width_px, image->height = height_px, image->component = 4, image->bits = 8;
  image->image.assign(pixels.get(), pixels.get() + size_t(4) * size_t(width_px) * size_t(height_px));
  return true;
}

void warn_of_absent_images(const tinygltf::Model& model, const Resources& resources, const fs::path& path) {
  for (const int i : resources.images) {
    const tinygltf::Image& image = model.images[static_cast<size_t>(i)];
    if (!image.image.empty()) continue;
    const auto broken = resources.broken_images.find(i);
    warn(
        "'{}': texture image {}{} {}; the material's colour factor is used alone", path.string(), i,
        image.uri.empty() ? "" : fmt::format(" ('{}')", percent_decoded(image.uri).substr(0, 200)),
        broken == resources.broken_images.end() ? "is missing" : fmt::format("cannot be decoded ({})", broken->second));
  }
}

/// tinygltf's messages have several lines and can quote a whole data URI.
std::string first_sentence(const std::string& text) {
  if (text.starts_with("Failed to decode 'uri'"))
    return "the data URI of a buffer is broken or has another length than its byteLength";
  std::string line = text.substr(0, text.find('\n'));
  constexpr size_t longest = 160;
  if (line.size() > longest) line = line.substr(0, longest) + "…";
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line.empty() ? "tinygltf gives no reason" : line;
}

}  // namespace

tinygltf::Model read_gltf_document(const fs::path& path, const std::function<void(double share)>& read) {
  Bytes bytes = read_bytes(path, whole_file, read);
  if (bytes.empty()) fail("it is empty");
  if (bytes.size() > 0xffffffffu) fail("it is larger than 4 GiB");
  const bool glb = is_glb(bytes);
  std::string_view text =
      glb ? glb_json(bytes) : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());

  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  Resources resources;
  Compression compression;
  std::string rewritten;  // the JSON, where it had to change
  {
    json root = parse_json(text, glb);
    check_gltf_json(root);
    add_buffer_files(root, folder, resources);
    add_images(root, folder, resources);
    compression = take_compression(root);
    if (compression.any()) rewritten = root.dump();
  }
  if (!rewritten.empty()) {
    bytes = glb ? glb_with_json(bytes, rewritten) : Bytes(rewritten.begin(), rewritten.end());
    text = std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(&decode_image, &resources);
  parser.SetFsCallbacks(
      {&resource_exists, [](const std::string& name, void*) { return name; }, &read_resource, nullptr, &resources});
  tinygltf::Model model;
  std::string error, ignored_warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool ok =
      glb ? parser.LoadBinaryFromMemory(&model, &error, &ignored_warning, bytes.data(), size, folder.string())
          : parser.LoadASCIIFromString(&model, &error, &ignored_warning, text.data(), size, folder.string());
  if (!ok) fail("{}", first_sentence(error));
  decompress(model, compression);
  warn_of_absent_images(model, resources, path);
  return model;
}

}  // namespace izb

// SPDX-License-Identifier: MIT
// Move-only GL objects, each with a label that debuggers and messages show.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gl.h"

namespace izb::gpu {

/// What a texture takes, all levels and layers together. Throws izb::Error for a format that izb does not use.
uint64_t texture_bytes(GLenum format, int width_px, int height_px, int layers = 1, int levels = 1);
/// What a buffer takes that was asked for `bytes`: an empty one cannot be bound.
constexpr uint64_t buffer_bytes(uint64_t bytes) {
  return bytes < 16 ? 16 : bytes;
}

/// Owns one GL name; Traits has create, destroy and the label's identifier.
template <typename Traits>
class Object {
 public:
  Object() = default;
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)), bytes_(std::exchange(other.bytes_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Object() {
    if (name_ != 0) Traits::destroy(name_);
  }
  GLuint name() const { return name_; }
  size_t bytes() const { return bytes_; }  ///< storage taken, 0 for objects without
  explicit operator bool() const { return name_ != 0; }

 protected:
  GLuint name_ = 0;
  size_t bytes_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct TextureTraits {
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayTraits {
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct QueryTraits {
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct SamplerTraits {
  static void destroy(GLuint name) { glDeleteSamplers(1, &name); }
};

class Buffer : public Object<BufferTraits> {
 public:
  Buffer() = default;
  /// Immutable storage of buffer_bytes(bytes), from `data` or undefined.
  Buffer(const std::string& label, size_t bytes, const void* data = nullptr);
  template <typename T>
  Buffer(const std::string& label, const std::vector<T>& data) : Buffer(label, data.size() * sizeof(T), data.data()) {}

  void update(size_t offset_bytes, size_t size_bytes, const void* data);
  void fill(uint32_t value);
  void fill(uint32_t value, size_t offset_bytes, size_t size_bytes);
  template <typename T>
  std::vector<T> read(size_t count) const {
    std::vector<T> data(count);
    read_bytes(0, count * sizeof(T), data.data());
    return data;
  }
  void read_bytes(size_t offset_bytes, size_t size_bytes, void* data) const;
};

class Texture : public Object<TextureTraits> {
 public:
  Texture() = default;
  /// Immutable 2D storage; nearest filter and clamped edges, since most of ours are read by texelFetch.
  Texture(const std::string& label, GLenum format, int width_px, int height_px, int levels = 1);
  /// An array of `layers` such textures, also of one.
  static Texture array(const std::string& label, GLenum format, int width_px, int height_px, int layers);
  /// Makes it anew, contents undefined, unless it is such a texture already. True: it was made anew.
  bool become(const std::string& label, GLenum format, int width_px, int height_px);
  bool become_array(const std::string& label, GLenum format, int width_px, int height_px, int layers);
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int layers() const { return layers_; }
  GLenum format() const { return format_; }
  void clear(GLenum format, GLenum type, const void* value);
  void clear_uint(uint32_t value) { clear(GL_RED_INTEGER, GL_UNSIGNED_INT, &value); }
  /// Level 0, all layers, bottom row first, tightly packed.
  template <typename T>
  std::vector<T> read(GLenum format, GLenum type, int components) const {
    std::vector<T> data(size_t(width_px_) * height_px_ * layers_ * components);
    read_bytes(format, type, data.size() * sizeof(T), data.data());
    return data;
  }
  std::vector<uint32_t> read_uint() const { return read<uint32_t>(GL_RED_INTEGER, GL_UNSIGNED_INT, 1); }
  void read_bytes(GLenum format, GLenum type, size_t bytes, void* data) const;

 private:
  bool is(GLenum format, int width_px, int height_px, int layers) const {
    return name_ != 0 && format_ == format && width_px_ == width_px && height_px_ == height_px && layers_ == layers;
  }
  void finish(const std::string& label, int levels);

  GLenum format_ = 0;
  int width_px_ = 0, height_px_ = 0, layers_ = 1;
};

/// A buffer of 32-bit words or bytes that shaders fetch as a texture of unsigned integers.
class BufferTexture : public Object<TextureTraits> {
 public:
  BufferTexture() = default;
  BufferTexture(const std::string& label, const std::vector<uint32_t>& words);
  BufferTexture(const std::string& label, const std::vector<uint8_t>& bytes);
  /// A view of a buffer that must outlive it; takes no memory of its own.
  BufferTexture(const std::string& label, GLenum format, const Buffer& buffer);

 private:
  void attach(const std::string& label, GLenum format, const Buffer& buffer);

  Buffer buffer_;
};

class Framebuffer : public Object<FramebufferTraits> {
 public:
  Framebuffer() = default;
  /// Colour attachments in order, then depth (either may be absent). Throws if the driver finds it incomplete.
  Framebuffer(const std::string& label, const std::vector<const Texture*>& colors, const Texture* depth);
  /// Without an attachment: drawing into it has side effects only. Several layers are chosen by gl_Layer.
  Framebuffer(const std::string& label, int width_px, int height_px, int layers = 1);
  /// One layer of a depth texture array.
  static Framebuffer depth_layer(const std::string& label, const Texture& depth, int layer);

 private:
  void create(const std::string& label);
  void check(const std::string& label) const;
};

class VertexArray : public Object<VertexArrayTraits> {
 public:
  VertexArray() = default;
  explicit VertexArray(const std::string& label);
};

class Query : public Object<QueryTraits> {
 public:
  Query() = default;
  Query(const std::string& label, GLenum target);
};

class Sampler : public Object<SamplerTraits> {
 public:
  Sampler() = default;
  explicit Sampler(const std::string& label);
};

}  // namespace izb::gpu

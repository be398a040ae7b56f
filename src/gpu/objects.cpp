// SPDX-License-Identifier: MIT
#include "gpu/objects.h"

#include <algorithm>

#include "base/error.h"

namespace izb::gpu {
namespace {

void label(GLenum identifier, GLuint name, const std::string& text) {
  glObjectLabel(identifier, name, static_cast<GLsizei>(text.size()), text.data());
}

size_t bytes_a_texel(GLenum format) {
  switch (format) {
    case GL_R8:
      return 1;
    case GL_DEPTH_COMPONENT16:
      return 2;
    case GL_RGBA8:
    case GL_SRGB8_ALPHA8:
    case GL_RG16:
    case GL_R32F:
    case GL_R32UI:
    case GL_DEPTH_COMPONENT32F:
      return 4;
    case GL_RG32F:
    case GL_RG32UI:
    case GL_RGBA16F:
      return 8;
    case GL_RGBA32F:
    case GL_RGBA32UI:
      return 16;
    default:
      fail("no size known for texture format {:#x}", format);
  }
}

}  // namespace

uint64_t texture_bytes(GLenum format, int width_px, int height_px, int layers, int levels) {
  uint64_t sum = 0;
  for (int level = 0; level < levels; ++level)
    sum += uint64_t{bytes_a_texel(format)} * static_cast<uint64_t>(std::max(1, width_px >> level)) *
           static_cast<uint64_t>(std::max(1, height_px >> level)) * static_cast<uint64_t>(layers);
  return sum;
}

Buffer::Buffer(const std::string& text, size_t bytes, const void* data) {
  glCreateBuffers(1, &name_);
  label(GL_BUFFER, name_, text);
  bytes_ = buffer_bytes(bytes);
  glNamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes_), bytes >= 16 ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (bytes < 16 && data) update(0, bytes, data);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    fail("the GL driver refused {} bytes for buffer '{}' (error {:#x})", bytes_, text, error);
}

void Buffer::update(size_t offset_bytes, size_t size_bytes, const void* data) {
  if (size_bytes > 0)
    glNamedBufferSubData(name_, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(size_bytes), data);
}

void Buffer::fill(uint32_t value) {
  glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::fill(uint32_t value, size_t offset_bytes, size_t size_bytes) {
  if (size_bytes > 0)
    glClearNamedBufferSubData(name_, GL_R32UI, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(size_bytes),
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::read_bytes(size_t offset_bytes, size_t size_bytes, void* data) const {
  if (size_bytes == 0) return;
  glGetNamedBufferSubData(name_, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(size_bytes), data);
  expect_context();
}

Texture::Texture(const std::string& text, GLenum format, int width_px, int height_px, int levels)
    : format_(format), width_px_(width_px), height_px_(height_px) {
  glCreateTextures(GL_TEXTURE_2D, 1, &name_);
  glTextureStorage2D(name_, levels, format, width_px, height_px);
  finish(text, levels);
}

Texture Texture::array(const std::string& text, GLenum format, int width_px, int height_px, int layers) {
  Texture t;
  t.format_ = format, t.width_px_ = width_px, t.height_px_ = height_px, t.layers_ = layers;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &t.name_);
  glTextureStorage3D(t.name_, 1, format, width_px, height_px, layers);
  t.finish(text, 1);
  return t;
}

// The old one goes first: its room may be needed.
bool Texture::become(const std::string& text, GLenum format, int width_px, int height_px) {
  if (is(format, width_px, height_px, 1)) return false;
  *this = Texture();
  *this = Texture(text, format, width_px, height_px);
  return true;
}

bool Texture::become_array(const std::string& text, GLenum format, int width_px, int height_px, int layers) {
  if (is(format, width_px, height_px, layers)) return false;
  *this = Texture();
  *this = array(text, format, width_px, height_px, layers);
  return true;
}

void Texture::finish(const std::string& text, int levels) {
  label(GL_TEXTURE, name_, text);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    fail("the GL driver refused texture '{}' of {} x {} x {} (error {:#x})", text, width_px_, height_px_, layers_,
         error);
  bytes_ = texture_bytes(format_, width_px_, height_px_, layers_, levels);
  glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(name_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

BufferTexture::BufferTexture(const std::string& text, const std::vector<uint32_t>& words) : buffer_(text, words) {
  attach(text, GL_R32UI, buffer_);
  bytes_ = buffer_.bytes();
}

BufferTexture::BufferTexture(const std::string& text, const std::vector<uint8_t>& bytes) : buffer_(text, bytes) {
  attach(text, GL_R8UI, buffer_);
  bytes_ = buffer_.bytes();
}

BufferTexture::BufferTexture(const std::string& text, GLenum format, const Buffer& buffer) {
  attach(text, format, buffer);
}

void BufferTexture::attach(const std::string& text, GLenum format, const Buffer& buffer) {
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &name_);
  glTextureBuffer(name_, format, buffer.name());
  label(GL_TEXTURE, name_, text);
}

void Texture::clear(GLenum format, GLenum type, const void* value) {
  glClearTexImage(name_, 0, format, type, value);
}

void Texture::read_bytes(GLenum format, GLenum type, size_t bytes, void* data) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(name_, 0, format, type, static_cast<GLsizei>(bytes), data);
  expect_context();
}

void Framebuffer::create(const std::string& text) {
  glCreateFramebuffers(1, &name_);
  label(GL_FRAMEBUFFER, name_, text);
}

void Framebuffer::check(const std::string& text) const {
  if (const GLenum status = glCheckNamedFramebufferStatus(name_, GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
    fail("the GL driver finds framebuffer '{}' incomplete ({:#x})", text, status);
}

Framebuffer::Framebuffer(const std::string& text, const std::vector<const Texture*>& colors, const Texture* depth) {
  create(text);
  std::vector<GLenum> buffers;
  for (size_t i = 0; i < colors.size(); ++i) {
    buffers.push_back(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i));
    glNamedFramebufferTexture(name_, buffers.back(), colors[i]->name(), 0);
  }
  if (buffers.empty()) buffers.push_back(GL_NONE);
  glNamedFramebufferDrawBuffers(name_, static_cast<GLsizei>(buffers.size()), buffers.data());
  if (depth) glNamedFramebufferTexture(name_, GL_DEPTH_ATTACHMENT, depth->name(), 0);
  check(text);
}

Framebuffer::Framebuffer(const std::string& text, int width_px, int height_px, int layers) {
  create(text);
  glNamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_WIDTH, width_px);
  glNamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height_px);
  if (layers > 1) glNamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_LAYERS, layers);
  check(text);
}

Framebuffer Framebuffer::depth_layer(const std::string& text, const Texture& depth, int layer) {
  Framebuffer f;
  f.create(text);
  glNamedFramebufferTextureLayer(f.name_, GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
  const GLenum none = GL_NONE;
  glNamedFramebufferDrawBuffers(f.name_, 1, &none);
  f.check(text);
  return f;
}

VertexArray::VertexArray(const std::string& text) {
  glCreateVertexArrays(1, &name_);
  label(GL_VERTEX_ARRAY, name_, text);
}

Query::Query(const std::string& text, GLenum target) {
  glCreateQueries(target, 1, &name_);
  label(GL_QUERY, name_, text);
}

Sampler::Sampler(const std::string& text) {
  glCreateSamplers(1, &name_);
  label(GL_SAMPLER, name_, text);
}

}  // namespace izb::gpu

// SPDX-License-Identifier: MIT
#pragma once
#include "gpu/objects.h"

namespace izb {

/// One shared struct in a uniform buffer.
template <typename T>
class UniformBlock {
 public:
  UniformBlock(const std::string& label, GLuint binding) : buffer_(label, sizeof(T)), binding_(binding) {}
  void set(const T& value) { buffer_.update(0, sizeof(T), &value); }
  void bind() const { glBindBufferBase(GL_UNIFORM_BUFFER, binding_, buffer_.name()); }

 private:
  gpu::Buffer buffer_;
  GLuint binding_;
};

}  // namespace izb

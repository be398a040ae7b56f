// SPDX-License-Identifier: MIT
#include "gpu/program.h"

#include <atomic>

#include "base/error.h"
#include "gpu/program_cache.h"

namespace izb::gpu {
namespace {

GLenum gl_kind(ShaderKind kind) {
  switch (kind) {
    case ShaderKind::vertex:
      return GL_VERTEX_SHADER;
    case ShaderKind::geometry:
      return GL_GEOMETRY_SHADER;
    case ShaderKind::fragment:
      return GL_FRAGMENT_SHADER;
    default:
      return GL_COMPUTE_SHADER;
  }
}

std::atomic<uint64_t> made{0};

/// The driver names files by their index (#line LINE INDEX): give the list, so that its message can be read.
std::string file_list(const CheckedShader& shader) {
  std::string text;
  for (size_t i = 0; i < shader.files.size(); ++i) text += fmt::format("\n  file {}: {}", i, shader.files[i]);
  return text;
}

}  // namespace

Program::Program(const ProgramSpec& spec) : spec_(spec) {
  ++made;
  name_ = glCreateProgram();
  glObjectLabel(GL_PROGRAM, name_, static_cast<GLsizei>(spec.label.size()), spec.label.data());
  const CachedProgram cached(spec);
  from_cache_ = cached.load(name_);
  if (from_cache_) return;
  for (const CheckedShader& checked : check_program(spec)) {
    const GLuint shader = glCreateShader(gl_kind(checked.kind));
    const GLchar* text = checked.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
      char log[4096] = {};
      glGetShaderInfoLog(shader, sizeof log, nullptr, log);
      glDeleteShader(shader);
      fail("the GL driver refused a shader of '{}':\n{}{}", spec.label, log, file_list(checked));
    }
    glAttachShader(name_, shader);
    glDeleteShader(shader);
  }
  cached.announce(name_);
  glLinkProgram(name_);
  GLint linked = 0;
  glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (!linked) {
    char log[4096] = {};
    glGetProgramInfoLog(name_, sizeof log, nullptr, log);
    fail("the GL driver cannot link '{}':\n{}", spec.label, log);
  }
  // Unless a shader file was changed meanwhile.
  if (CachedProgram(spec).file() == cached.file()) cached.store(name_);
}

void Program::become(const ProgramSpec& spec) {
  if (!is(spec)) *this = Program(spec);
}

uint64_t programs_made() {
  return made;
}

void Program::dispatch(int width, int height, int group_w, int group_h, int layers) const {
  use();
  glDispatchCompute(static_cast<GLuint>((width + group_w - 1) / group_w),
                    static_cast<GLuint>((height + group_h - 1) / group_h), static_cast<GLuint>(layers));
}

}  // namespace izb::gpu

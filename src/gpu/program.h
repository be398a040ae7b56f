// SPDX-License-Identifier: MIT
#pragma once
#include "gpu/glsl_front_end.h"
#include "gpu/objects.h"

namespace izb::gpu {

struct ProgramTraits {
  static void destroy(GLuint name) { glDeleteProgram(name); }
};

/// A linked program. All bindings and locations are explicit in the text, so there is nothing to look up.
class Program : public Object<ProgramTraits> {
 public:
  Program() = default;
  /// Takes it from the cache on disk (gpu/program_cache.h), or else checks with glslang, compiles and links. Throws
  /// izb::Error with file:line.
  explicit Program(const ProgramSpec& spec);
  /// Makes it anew, unless it is that program already.
  void become(const ProgramSpec& spec);
  bool is(const ProgramSpec& spec) const { return name_ != 0 && spec_ == spec; }

  /// Whether it has not been compiled, but comes from the cache on disk.
  bool from_cache() const { return from_cache_; }

  void use() const { glUseProgram(name_); }
  /// Uses the program and runs it over at least `width` x `height` invocations in groups of group_w x group_h, `layers`
  /// times (gl_WorkGroupID.z).
  void dispatch(int width, int height, int group_w, int group_h, int layers = 1) const;

 private:
  ProgramSpec spec_;
  bool from_cache_ = false;
};

/// How many have been made since the process began, compiled or from the cache.
uint64_t programs_made();

}  // namespace izb::gpu

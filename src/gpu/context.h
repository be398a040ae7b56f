// SPDX-License-Identifier: MIT
// An OpenGL 4.5 core context without a screen, by name.
#pragma once
#include <memory>
#include <string>
#include <vector>

namespace izb::gpu {

/// A current context; destroyed with the object. GL objects must go before it.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  /// Which of its ways to a context it took, e.g. EGL's "surfaceless"; "": there is only one.
  virtual std::string platform() const { return {}; }

 protected:
  Context() = default;
};

struct ContextAttempt {
  std::string name;     ///< "egl", "osmesa" or "glfw"
  std::string failure;  ///< why it was not taken; empty: this one was taken
};

struct ContextResult {
  std::unique_ptr<Context> context;
  std::string name;
  std::vector<ContextAttempt> attempts;
};

/// Creates and makes current a 4.5 core context: "egl", "osmesa", "glfw" (hidden window), or "auto", which tries them
/// in that order. `debug` asks for a debug context. Throws izb::Error that names every context tried and why it failed.
ContextResult create_context(const std::string& name, bool debug);

/// The names that create_context takes.
std::vector<std::string> context_names();

using GetProcAddress = void* (*)(const char* name);

/// Fills the function table of gpu/gl.h. Throws izb::Error naming the first function that is missing. (Declared here,
/// since OSMesa's header brings GL prototypes of its own, which the table's names would clash with.)
void load_gl(GetProcAddress get_proc_address);

// One factory a file; each throws izb::Error with the reason. They load the GL functions.
std::unique_ptr<Context> create_egl_context(bool debug);
std::unique_ptr<Context> create_osmesa_context(bool debug);
std::unique_ptr<Context> create_glfw_context(bool debug);

}  // namespace izb::gpu

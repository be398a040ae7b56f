// SPDX-License-Identifier: MIT
#include "gpu/gl.h"

#include "base/error.h"
#include "gpu/context.h"

#define IZB_DEFINE(type, name) type name = nullptr;
IZB_GL_FUNCTIONS(IZB_DEFINE)
IZB_GL_EXTENSION_FUNCTIONS(IZB_DEFINE)
#undef IZB_DEFINE

namespace izb::gpu {

void load_gl(GetProcAddress get_proc_address) {
#define IZB_LOAD(type, name)                              \
  name = reinterpret_cast<type>(get_proc_address(#name)); \
  if (name == nullptr) fail("the GL driver has no {}", #name);
  IZB_GL_FUNCTIONS(IZB_LOAD)
#undef IZB_LOAD
#define IZB_LOAD(type, name) name = reinterpret_cast<type>(get_proc_address(#name));
  IZB_GL_EXTENSION_FUNCTIONS(IZB_LOAD)
#undef IZB_LOAD
}

void expect_context() {
  switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR:
      return;
    case GL_GUILTY_CONTEXT_RESET:
      fail("the GL driver has reset this program's context: a fault, or work beyond the driver's time limit");
    case GL_INNOCENT_CONTEXT_RESET:
      fail("the GL driver has reset the GPU because of another program; start this one again");
    default:
      fail("the GL driver has reset the GPU for a reason unknown; start this program again");
  }
}

}  // namespace izb::gpu

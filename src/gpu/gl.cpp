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

}  // namespace izb::gpu

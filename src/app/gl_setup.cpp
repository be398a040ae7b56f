// SPDX-License-Identifier: MIT
#include "app/gl_setup.h"

#include <cstdlib>

namespace izb {

Gl::Gl(const std::string& context_name)
    : context(gpu::create_context(context_name, std::getenv("IZB_GL_DEBUG") != nullptr)),
      capabilities(gpu::query_capabilities()) {
  if (std::getenv("IZB_GL_DEBUG")) gpu::enable_debug_messages();
}

}  // namespace izb

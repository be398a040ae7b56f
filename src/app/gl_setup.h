// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "gpu/capabilities.h"
#include "gpu/context.h"

namespace izb {

/// A GL context and what the driver says of itself. $IZB_GL_DEBUG set: KHR_debug messages are shown, and counted.
struct Gl {
  explicit Gl(const std::string& context_name);
  gpu::ContextResult context;
  gpu::Capabilities capabilities;
};

}  // namespace izb

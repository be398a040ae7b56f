// SPDX-License-Identifier: MIT
#ifndef IZB_HAVE_WINDOW
#include "base/error.h"
#include "view/run_view.h"

namespace izb {

int run_view(const ViewOptions&, ViewState) {
  fail("this build has no window, since GLFW or Dear ImGui was missing: `izb render` writes pictures without one");
}

}  // namespace izb
#endif

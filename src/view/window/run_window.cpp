// SPDX-License-Identifier: MIT
#include <malloc.h>

#include "base/error.h"
#include "view/run_view.h"
#include "view/window/ui.h"

namespace izb {
namespace {

/// What a person chooses makes and frees blocks of many sizes, some of megabytes, in several threads. Given back to the
/// system at once, they do not leave the heaps full of holes; glibc's own threshold would rise to 32 MB.
void return_large_blocks() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 18);
  mallopt(M_TRIM_THRESHOLD, 1 << 20);
#endif
}

}  // namespace

int run_view(const ViewOptions& options, ViewState state) {
  return_large_blocks();
  Report report(options.report);
  std::unique_ptr<Window> window;
  std::unique_ptr<Painter> painter;
  try {
    window = std::make_unique<Window>("izb", parse_size(state.frame.size));
    painter = std::make_unique<Painter>(Painter::Setup{options.context, [] { Window::wake(); }});
  } catch (const UsageError&) {
    throw;
  } catch (const Error& e) {
    fail("{}: `izb render` writes pictures without a window", e.what());
  }
  Ui(*window, *painter, report, {std::move(state), options.folder, options.settings}).run();
  painter.reset();  // it wakes the window
  return 0;
}

}  // namespace izb

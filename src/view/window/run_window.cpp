// SPDX-License-Identifier: MIT
#include "base/error.h"
#include "view/run_view.h"
#include "view/window/ui.h"

namespace izb {

int run_view(const ViewOptions& options, ViewState state) {
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

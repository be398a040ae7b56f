// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "view/state.h"

namespace izb {

struct ViewOptions {
  std::string context = "auto", folder = ".", settings, report, state;
};

/// Opens the window and returns when it is closed: 0. Throws izb::Error if there can be none.
int run_view(const ViewOptions& options, ViewState state);

}  // namespace izb

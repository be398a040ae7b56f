// SPDX-License-Identifier: MIT
// The subcommands. Each declares itself on the application and returns what runs it: exit code 0, or 1 for a failed
// check; failures throw izb::Error.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/options.h"

namespace izb {

using Command = std::function<int()>;

/// The words of the command line, program name excluded.
using Arguments = std::vector<std::string>;

Command add_render(CLI::App& app, const Arguments& arguments);
Command add_validate(CLI::App& app, const Arguments& arguments);
Command add_compare(CLI::App& app, const Arguments& arguments);
Command add_bench(CLI::App& app, const Arguments& arguments);
Command add_bench_job(CLI::App& app);
Command add_info(CLI::App& app);
Command add_scene(CLI::App& app);
Command add_view(CLI::App& app, const Arguments& arguments);

}  // namespace izb

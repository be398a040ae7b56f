// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>

#include "app/commands.h"
#include "base/error.h"
#include "base/file.h"
#include "base/version.h"

namespace {

constexpr int exit_failure = 1, exit_usage = 2;

int run(int argc, char** argv) {
  CLI::App app{"Irregular z-buffer shadows: alias-free hard shadows by OpenGL 4.5, checked by ray tracing", "izb"};
  app.set_version_flag("--version", fmt::format("izb {} ({})", izb::version(), izb::commit()));
  app.require_subcommand(1);
  const izb::Arguments arguments(argv + 1, argv + argc);
  const std::pair<const char*, izb::Command> commands[] = {
      {"render", izb::add_render(app, arguments)},
      {"validate", izb::add_validate(app, arguments)},
      {"compare", izb::add_compare(app, arguments)},
      {"bench", izb::add_bench(app, arguments)},
      {"bench-job", izb::add_bench_job(app)},
      {"view", izb::add_view(app, arguments)},
      {"info", izb::add_info(app)},
      {"scene", izb::add_scene(app)},
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    std::string sentence = e.what();
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    throw izb::UsageError(sentence);
  }
  for (const auto& [name, command] : commands)
    if (app.got_subcommand(name)) return command();
  return exit_usage;
}

}  // namespace

int main(int argc, char** argv) {
  izb::remove_temporaries_on_signals();
  try {
    return run(argc, argv);
  } catch (const izb::UsageError& e) {
    fmt::print(stderr, "izb: {}\n", e.what());
    return exit_usage;
  } catch (const izb::Error& e) {
    fmt::print(stderr, "izb: {}\n", e.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "izb: not enough memory\n");
  } catch (const std::exception& e) {
    fmt::print(stderr, "izb: unexpected failure: {}\n", e.what());
  }
  return exit_failure;
}

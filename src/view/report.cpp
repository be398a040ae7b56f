// SPDX-License-Identifier: MIT
#include "view/report.h"

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace izb {

Report::Report(const std::string& path) {
  if (path.empty()) return;
  file_.reset(std::fopen(path.c_str(), "w"));
  if (!file_) fail("cannot write the report '{}': {}", path, std::strerror(errno));
}

void Report::write(const char* event, nlohmann::json keys) {
  if (!file_) return;
  const std::scoped_lock lock(mutex_);
  keys["event"] = event;
  keys["t_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  // Names of files need not be UTF-8.
  fmt::print(file_.get(), "{}\n", keys.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  std::fflush(file_.get());
}

}  // namespace izb

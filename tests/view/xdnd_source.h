// SPDX-License-Identifier: MIT
// A file manager's part of drag and drop: the source side of XDND 5, for files.
#pragma once
#include <filesystem>
#include <vector>

#include "view/x_display.h"

namespace izb::test {

/// Drops files on the window in use at `at`. Returns false if the window refuses them. Throws std::runtime_error if it
/// takes no drops or does not answer.
bool drop_files(XDisplay& display, const std::vector<std::filesystem::path>& files, Point at);

/// The list as text/uri-list (RFC 2483): absolute paths, percent-encoded, a line each.
std::string uri_list(const std::vector<std::filesystem::path>& files);

}  // namespace izb::test

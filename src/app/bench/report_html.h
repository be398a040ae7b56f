// SPDX-License-Identifier: MIT
// The parts of the report's page as HTML and CSV.
#pragma once
#include <string>
#include <string_view>

#include "app/bench/report_document.h"

namespace izb::report {

/// Text for between tags and within quotes: what HTML would take for its own is escaped, control characters become
/// U+FFFD.
std::string escaped(std::string_view text);

/// The same, with `code` between backticks as code.
std::string prose(std::string_view text);

/// A number for reading: commas between thousands, a true minus sign, `digits` behind the point. Without `digits` a
/// whole number is whole and another has up to six significant digits.
std::string number_text(const nlohmann::json& number, std::optional<int> digits);

/// JSON that may stand within a script element.
std::string script_json(const nlohmann::json& json);

/// The table as RFC 4180 has it, numbers in full. A last column holds the notes, if there are any.
std::string csv(const Table& table);

/// The mark of what was measured on software GL.
std::string software_badge();

/// The table without a caption: the box that it scrolls in, what its marks mean, and the link to its CSV.
std::string table_html(const Table& table);

std::string facts_html(const std::vector<Fact>& facts);

/// `with_plots`: there is d3 to draw it; otherwise a sentence stands in its place.
std::string plot_html(const Plot& plot, bool with_plots);

}  // namespace izb::report

// SPDX-License-Identifier: MIT
// A table of the report, in the form that make_report() takes, and the same as CSV.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace izb::bench {

struct ReportColumn {
  std::string name;
  std::string unit = {};
  int digits = 1;          ///< behind the point
  std::string group = {};  ///< a header above several columns
  bool paper = false;      ///< the paper's own number
  bool text = false;
};

class ReportTable {
 public:
  ReportTable(std::string id, std::string caption, std::vector<ReportColumn> columns);
  /// A row: numbers, texts, or no_value() where there is no number. As many as columns, or std::logic_error.
  void add(std::vector<nlohmann::json> cells);
  bool empty() const { return json_["rows"].empty(); }
  const nlohmann::json& json() const { return json_; }

 private:
  nlohmann::json json_;
};

/// A cell without a number, and why.
nlohmann::json no_value(const std::string& reason);

/// The table as CSV (RFC 4180): a header line with units, then a line a row. A cell without a number holds "n/a: " and
/// the reason.
std::string csv_of(const nlohmann::json& table);

}  // namespace izb::bench

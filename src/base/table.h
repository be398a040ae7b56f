// SPDX-License-Identifier: MIT
// Small tables of text for a terminal.
#pragma once
#include <string>
#include <vector>

namespace izb {

enum class Align { left, right };

/// One column of a table: its header and the side on which its cells line up.
struct Column {
  std::string header;
  Align align = Align::right;
};

/// A header line and rows of cells, each column as wide as its widest cell.
class Table {
 public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Appends a row; missing cells at its end are empty. More cells than columns is a bug: std::logic_error.
  void add_row(std::vector<std::string> cells);

  /// The table as lines that end in '\n', without trailing blanks. Widths count UTF-8 characters.
  std::string str() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace izb

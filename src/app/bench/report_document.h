// SPDX-License-Identifier: MIT
// The document of a report, read and checked: what report.h describes as JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace izb::report {

enum class Source { none, measured, paper };

struct Fact {
  std::string name, value;
};

struct Column {
  std::string name, unit, group;
  std::string empty;  ///< why a cell of it may be null; empty: none may
  Source source = Source::none;
  bool left = false;  ///< on which side its cells line up
  std::optional<int> digits{};
};

struct Cell {
  nlohmann::json value;  ///< number, string, or null
  std::string note;      ///< why there is no value, or a remark on it
};

using Row = std::vector<Cell>;

struct Table {
  std::string id, caption;
  std::vector<Column> columns;
  std::vector<Row> rows, summary;  ///< as many cells as columns
  bool software = false;
};

enum class Scale { linear, log, category };

struct Axis {
  std::string label, unit;
  Scale scale = Scale::linear;
  std::optional<int> digits{};
};

struct Series {
  using Values = std::vector<std::optional<double>>;
  std::string name, stack;
  Source source = Source::measured;
  Values values, low, high;  ///< as many as the plot has x values; low and high may be empty
};

enum class PlotKind { line, bars, stacked };

struct Plot {
  std::string id, title, caption;
  PlotKind kind = PlotKind::line;
  Axis x, y;
  std::vector<nlohmann::json> x_values;  ///< numbers, of a category axis strings
  std::vector<Series> series;
  bool software = false;
};

struct Picture {
  std::string file, label;
};

struct Pictures {
  std::string title, caption;
  bool pixelated = false;
  std::vector<Picture> files;
};

struct Section {
  std::string id, title;
  std::vector<std::string> text, notes;
  std::vector<Fact> facts;
  bool software = false;
  std::vector<Table> tables;
  std::vector<Plot> plots;
  std::vector<Pictures> images;
};

struct Document {
  std::string title, subtitle;
  std::vector<Fact> facts;
  bool software = false;
  std::vector<Section> sections;
};

/// Throws izb::Error that names the place ("sections[0].tables[1].rows[3]: ...") where the JSON does not fit, and
/// std::logic_error where a plot mixes software GL with a GPU.
Document read_document(const nlohmann::json& json);

/// The plot's values as a table, a row for each x value.
Table table_of(const Plot& plot);

}  // namespace izb::report

// SPDX-License-Identifier: MIT
#include "app/bench/report_document.h"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string_view>

#include "base/error.h"
#include "base/json_text.h"

namespace izb::report {
namespace {

/// A value of the document, and where it stands: for messages.
class Node {
 public:
  Node(const nlohmann::json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  const nlohmann::json& json() const { return *json_; }
  const std::string& path() const { return path_; }

  template <typename... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    fail("the report's document does not fit: {}: {}", path_.empty() ? "at the top" : path_,
         fmt::format(text, std::forward<Args>(args)...));
  }

  /// It is an object of these keys and no others: a key that nobody reads is a slip of the pen.
  void only(std::initializer_list<std::string_view> keys) const {
    if (!json_->is_object()) refuse("an object is expected");
    for (const auto& [key, value] : json_->items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) refuse("there is no key \"{}\"", key);
  }

  bool has(const char* key) const { return json_->contains(key); }

  Node at(const char* key) const {
    if (!has(key)) refuse("\"{}\" is missing", key);
    return {(*json_)[key], path_.empty() ? key : path_ + "." + key};
  }

  /// Its elements, if it is an array.
  std::vector<Node> elements() const {
    if (!json_->is_array()) refuse("an array is expected");
    std::vector<Node> nodes;
    for (size_t i = 0; i < json_->size(); ++i) nodes.emplace_back((*json_)[i], fmt::format("{}[{}]", path_, i));
    return nodes;
  }

  /// Those of a key; none where it is left out.
  std::vector<Node> list(const char* key) const { return has(key) ? at(key).elements() : std::vector<Node>(); }

  std::string string() const {
    if (!json_->is_string()) refuse("a string is expected");
    return json_->get<std::string>();
  }

  std::string text(const char* key) const { return at(key).string(); }
  std::string text(const char* key, const std::string& otherwise) const { return has(key) ? text(key) : otherwise; }

  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> result;
    for (const Node& node : list(key)) result.push_back(node.string());
    return result;
  }

  bool flag(const char* key, bool otherwise) const {
    if (!has(key)) return otherwise;
    if (!at(key).json().is_boolean()) at(key).refuse("true or false is expected");
    return at(key).json().get<bool>();
  }

  std::optional<int> digits() const {
    if (!has("digits")) return {};
    const Node node = at("digits");
    if (!node.json().is_number_integer() || node.json() < 0 || node.json() > 9)
      node.refuse("a whole number from 0 to 9 is expected");
    return node.json().get<int>();
  }

  /// The one of `words` that a key names, by its index; `otherwise` where the key is left out.
  template <typename Enum>
  Enum word(const char* key, std::initializer_list<std::string_view> words, Enum otherwise) const {
    if (!has(key)) return otherwise;
    const auto found = std::find(words.begin(), words.end(), text(key));
    if (found == words.end()) at(key).refuse("\"{}\" is none of {}", text(key), fmt::join(words, ", "));
    return Enum(found - words.begin());
  }

 private:
  const nlohmann::json* json_;
  std::string path_;
};

Source read_source(const Node& node, Source otherwise) {
  return node.word<Source>("source", {"none", "measured", "paper"}, otherwise);
}

/// Ids name anchors and files, and so are unique: those of the sections, and those of the tables and plots.
class Ids {
 public:
  std::string read(const Node& node) {
    const std::string id = node.text("id");
    const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
    if (id.empty() || !plain) node.at("id").refuse("\"{}\" is no id: letters, digits, '-' and '_'", id);
    reserve(node, id);
    return id;
  }

  void reserve(const Node& node, const std::string& id) {
    if (!seen_.insert(id).second) node.at("id").refuse("\"{}\" is the id of something else, too", id);
  }

 private:
  std::set<std::string> seen_;
};

std::vector<Fact> read_facts(const Node& node) {
  std::vector<Fact> facts;
  for (const Node& fact : node.list("facts")) {
    const std::vector<Node> pair = fact.elements();
    if (pair.size() != 2) fact.refuse("a name and a value are expected");
    facts.push_back({pair[0].string(), pair[1].string()});
  }
  return facts;
}

Column read_column(const Node& node, const std::string& table_empty) {
  node.only({"name", "unit", "digits", "align", "source", "group", "empty"});
  Column column;
  column.name = node.text("name");
  column.unit = node.text("unit", "");
  column.group = node.text("group", "");
  column.empty = node.text("empty", table_empty);
  column.source = read_source(node, Source::none);
  column.left = node.word<int>("align", {"left", "right"}, 1) == 0;
  column.digits = node.digits();
  return column;
}

Cell read_cell(const Node& node, const Column& column) {
  const nlohmann::json& json = node.json();
  if (json.is_number() || json.is_string()) return {json, {}};
  if (json.is_null()) {
    if (column.empty.empty()) node.refuse("it is empty, and neither it nor \"empty\" of the column says why");
    return {{}, column.empty};
  }
  if (!json.is_object()) node.refuse("a number, a string, null or an object is expected");
  if (node.has("reason")) {
    node.only({"reason"});
    return {{}, node.text("reason")};
  }
  node.only({"value", "note"});
  const Node value = node.at("value");
  if (!value.json().is_number() && !value.json().is_string()) value.refuse("a number or a string is expected");
  return {value.json(), node.text("note")};
}

std::vector<Row> read_rows(const Node& node, const char* key, const std::vector<Column>& columns) {
  std::vector<Row> rows;
  for (const Node& row : node.list(key)) {
    const std::vector<Node> cells = row.elements();
    if (cells.size() != columns.size()) row.refuse("{} cells for {} columns", cells.size(), columns.size());
    Row& read = rows.emplace_back();
    for (size_t i = 0; i < cells.size(); ++i) read.push_back(read_cell(cells[i], columns[i]));
  }
  return rows;
}

Table read_table(const Node& node, bool software, Ids& ids) {
  node.only({"id", "caption", "columns", "rows", "summary", "software", "empty"});
  Table table;
  table.id = ids.read(node);
  table.caption = node.text("caption");
  for (const Node& column : node.at("columns").elements())
    table.columns.push_back(read_column(column, node.text("empty", "")));
  if (table.columns.empty()) node.refuse("it has no columns");
  node.at("rows");
  table.rows = read_rows(node, "rows", table.columns);
  table.summary = read_rows(node, "summary", table.columns);
  table.software = node.flag("software", software);
  return table;
}

Axis read_axis(const Node& node, bool is_x) {
  is_x ? node.only({"label", "unit", "scale", "values"}) : node.only({"label", "unit", "scale", "digits"});
  Axis axis;
  axis.label = node.text("label", "");
  axis.unit = node.text("unit", "");
  axis.scale = node.word("scale", {"linear", "log", "category"}, Scale::linear);
  axis.digits = node.digits();
  if (!is_x && axis.scale == Scale::category) node.refuse("y has no categories");
  return axis;
}

std::vector<nlohmann::json> read_x_values(const Node& node, Scale scale) {
  std::vector<nlohmann::json> values;
  for (const Node& value : node.at("values").elements()) {
    if (scale == Scale::category) {
      value.string();
    } else {
      if (!value.json().is_number()) value.refuse("a number is expected");
      if (scale == Scale::log && !(value.json() > 0)) value.refuse("{} has no logarithm", json_text(value.json()));
      if (!values.empty() && !(values.back() < value.json())) value.refuse("the values must rise");
    }
    values.push_back(value.json());
  }
  if (values.empty()) node.refuse("it has no values");
  return values;
}

Series::Values read_values(const Node& node, const char* key, const Plot& plot) {
  Series::Values values;
  for (const Node& value : node.list(key)) {
    std::optional<double>& read = values.emplace_back();
    if (value.json().is_null()) continue;
    if (!value.json().is_number()) value.refuse("a number or null is expected");
    read = value.json().get<double>();
    if (plot.y.scale == Scale::log && !(*read > 0.0)) value.refuse("{} has no logarithm", *read);
    if (plot.kind == PlotKind::stacked && *read < 0.0) value.refuse("{} cannot be stacked", *read);
  }
  if (node.has(key) && values.size() != plot.x_values.size())
    node.at(key).refuse("{} values for {} of x", values.size(), plot.x_values.size());
  return values;
}

Series read_series(const Node& node, const Plot& plot) {
  node.only({"name", "source", "values", "low", "high", "stack", "software"});
  Series series;
  series.name = node.text("name");
  series.source = read_source(node, Source::measured);
  if (series.source == Source::none) node.at("source").refuse("a series is \"measured\" or of the \"paper\"");
  series.stack = node.text("stack", series.source == Source::paper ? "paper" : "measured");
  node.at("values");
  series.values = read_values(node, "values", plot);
  series.low = read_values(node, "low", plot);
  series.high = read_values(node, "high", plot);
  if (series.low.empty() != series.high.empty()) node.refuse("\"low\" and \"high\" come together");
  if (plot.kind == PlotKind::stacked && !series.low.empty()) node.refuse("stacked bars have no spread");
  return series;
}

/// The id of the table of its values.
std::string values_id(const Plot& plot) {
  return plot.id + "-values";
}

Plot read_plot(const Node& node, bool software, Ids& ids) {
  node.only({"id", "kind", "title", "caption", "x", "y", "series", "software"});
  Plot plot;
  plot.id = ids.read(node);
  ids.reserve(node, values_id(plot));
  plot.title = node.text("title");
  plot.caption = node.text("caption", "");
  node.at("kind");
  plot.kind = node.word("kind", {"line", "bars", "stacked"}, PlotKind::line);
  plot.x = read_axis(node.at("x"), true);
  plot.y = read_axis(node.at("y"), false);
  if (plot.kind != PlotKind::line && plot.x.scale != Scale::category) node.at("x").refuse("bars have categories");
  if (plot.kind == PlotKind::stacked && plot.y.scale == Scale::log) node.at("y").refuse("stacked bars are linear");
  plot.x_values = read_x_values(node.at("x"), plot.x.scale);

  std::optional<bool> measured;
  if (node.has("software")) measured = node.flag("software", software);
  std::set<std::pair<std::string, std::string>> names;
  for (const Node& series : node.at("series").elements()) {
    plot.series.push_back(read_series(series, plot));
    const Series& read = plot.series.back();
    const std::string where = plot.kind == PlotKind::stacked ? read.stack : read.source == Source::paper ? "paper" : "";
    if (!names.emplace(read.name, where).second) series.refuse("\"{}\" is there twice", read.name);
    if (read.source == Source::paper) continue;
    const bool of_series = series.flag("software", node.flag("software", software));
    if (measured && *measured != of_series)
      throw std::logic_error(
          fmt::format("{} ({}) mixes times of software GL with those of a GPU", node.path(), plot.id));
    measured = of_series;
  }
  if (plot.series.empty()) node.refuse("it has no series");
  plot.software = measured.value_or(software);
  return plot;
}

Pictures read_pictures(const Node& node) {
  node.only({"title", "caption", "files", "pixelated"});
  Pictures pictures;
  pictures.title = node.text("title");
  pictures.caption = node.text("caption", "");
  pictures.pixelated = node.flag("pixelated", false);
  for (const Node& file : node.at("files").elements()) {
    file.only({"file", "label"});
    pictures.files.push_back({file.text("file"), file.text("label")});
  }
  if (pictures.files.empty()) node.refuse("it has no files");
  return pictures;
}

Section read_section(const Node& node, bool software, Ids& section_ids, Ids& ids) {
  node.only({"id", "title", "text", "facts", "notes", "software", "tables", "plots", "images"});
  Section section;
  section.id = section_ids.read(node);
  section.title = node.text("title");
  section.text = node.texts("text");
  section.notes = node.texts("notes");
  section.facts = read_facts(node);
  section.software = node.flag("software", software);
  for (const Node& table : node.list("tables")) section.tables.push_back(read_table(table, section.software, ids));
  for (const Node& plot : node.list("plots")) section.plots.push_back(read_plot(plot, section.software, ids));
  for (const Node& images : node.list("images")) section.images.push_back(read_pictures(images));
  return section;
}

nlohmann::json cell_value(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace

Document read_document(const nlohmann::json& json) {
  const Node node(json, "");
  node.only({"title", "subtitle", "facts", "software", "sections"});
  Document document;
  document.title = node.text("title");
  document.subtitle = node.text("subtitle", "");
  document.facts = read_facts(node);
  document.software = node.flag("software", false);
  Ids section_ids, ids;
  for (const Node& section : node.at("sections").elements())
    document.sections.push_back(read_section(section, document.software, section_ids, ids));
  return document;
}

Table table_of(const Plot& plot) {
  Table table;
  table.id = values_id(plot);
  table.software = plot.software;
  table.columns.push_back({plot.x.label, plot.x.unit, "", "", Source::none, plot.x.scale == Scale::category});
  const bool stacks = std::any_of(plot.series.begin(), plot.series.end(),
                                  [&](const Series& s) { return s.stack != plot.series.front().stack; });
  for (const Series& series : plot.series) {
    Column column{series.name, plot.y.unit, "", "", series.source, false, plot.y.digits};
    if (plot.kind == PlotKind::stacked && stacks) column.group = series.stack;
    table.columns.push_back(column);
    if (series.low.empty()) continue;
    for (const char* end : {"low", "high"}) {
      column.name = fmt::format("{}, {}", series.name, end);
      table.columns.push_back(column);
    }
  }
  for (size_t i = 0; i < plot.x_values.size(); ++i) {
    Row& row = table.rows.emplace_back();
    row.push_back({plot.x_values[i], {}});
    for (const Series& series : plot.series) {
      row.push_back({cell_value(series.values[i]), {}});
      if (series.low.empty()) continue;
      row.push_back({cell_value(series.low[i]), {}});
      row.push_back({cell_value(series.high[i]), {}});
    }
  }
  return table;
}

}  // namespace izb::report

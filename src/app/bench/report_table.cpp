// SPDX-License-Identifier: MIT
#include "app/bench/report_table.h"

#include <fmt/format.h>

#include <stdexcept>

#include "base/json_text.h"

namespace izb::bench {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string header(const nlohmann::json& column) {
  std::string text;
  if (column.contains("group")) text = column["group"].get<std::string>() + ": ";
  text += column["name"].get<std::string>();
  if (column.value("source", "measured") == std::string("paper")) text += ", paper";
  if (column.contains("unit")) text += " (" + column["unit"].get<std::string>() + ")";
  return text;
}

std::string cell(const nlohmann::json& value) {
  if (value.is_string()) return value;
  if (value.is_object()) return "n/a: " + value.at("reason").get<std::string>();
  if (value.is_null()) throw std::logic_error("a cell without a value needs a reason");
  return json_text(value);
}

}  // namespace

ReportTable::ReportTable(std::string id, std::string caption, std::vector<ReportColumn> columns)
    : json_{{"id", std::move(id)},
            {"caption", std::move(caption)},
            {"columns", nlohmann::json::array()},
            {"rows", nlohmann::json::array()}} {
  for (ReportColumn& c : columns) {
    nlohmann::json column{{"name", c.name}, {"source", c.paper ? "paper" : "measured"}};
    if (!c.unit.empty()) column["unit"] = c.unit;
    if (!c.group.empty()) column["group"] = c.group;
    if (c.text)
      column["align"] = "left";
    else
      column["digits"] = c.digits;
    json_["columns"].push_back(std::move(column));
  }
}

void ReportTable::add(std::vector<nlohmann::json> cells) {
  if (cells.size() != json_["columns"].size()) throw std::logic_error("a row needs a cell for each column");
  json_["rows"].push_back(std::move(cells));
}

nlohmann::json no_value(const std::string& reason) {
  return {{"reason", reason}};
}

std::string csv_of(const nlohmann::json& table) {
  std::string text, separator;
  for (const nlohmann::json& column : table["columns"]) {
    text += separator + quoted(header(column));
    separator = ",";
  }
  text += "\r\n";
  for (const nlohmann::json& row : table["rows"]) {
    separator.clear();
    for (const nlohmann::json& value : row) {
      text += separator + quoted(cell(value));
      separator = ",";
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace izb::bench

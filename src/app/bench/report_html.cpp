// SPDX-License-Identifier: MIT
#include "app/bench/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/base64.h"
#include "base/json_text.h"

namespace izb::report {
namespace {

/// What the marks of a table's cells say: each sentence once, in the order in which a reader meets them.
class Notes {
 public:
  /// The mark of a note: a, b, ..., z, aa, ab, ...
  std::string mark(const std::string& note) {
    size_t index = size_t(std::find(notes_.begin(), notes_.end(), note) - notes_.begin());
    if (index == notes_.size()) notes_.push_back(note);
    return letters(index);
  }

  std::string html(const std::string& table_id) const {
    if (notes_.empty()) return {};
    std::string list = "<ul class=\"marks\">\n";
    for (size_t i = 0; i < notes_.size(); ++i)
      list +=
          fmt::format("<li id=\"{}-{}\"><sup>{}</sup> {}</li>\n", table_id, letters(i), letters(i), prose(notes_[i]));
    return list + "</ul>\n";
  }

 private:
  static std::string letters(size_t index) {
    std::string text;
    for (size_t rest = index + 1; rest > 0; rest = (rest - 1) / 26)
      text.insert(text.begin(), char('a' + (rest - 1) % 26));
    return text;
  }

  std::vector<std::string> notes_;
};

const char* word(Source source) {
  return source == Source::paper ? "paper" : source == Source::measured ? "measured" : "";
}

/// Long names of files break where a reader would break them.
std::string breakable(std::string_view text) {
  std::string html;
  for (size_t from = 0; from < text.size();) {
    const size_t to = std::min(text.find_first_of("_/-", from), text.size() - 1) + 1;
    html += escaped(text.substr(from, to - from));
    if (to < text.size()) html += "<wbr>";
    from = to;
  }
  return html;
}

std::string classes(const Table& table, size_t i) {
  const Column& column = table.columns[i];
  std::string names = column.left ? "text" : "num";
  if (column.source == Source::paper) names += " paper";
  if (i > 0 && (!column.group.empty() || !table.columns[i - 1].group.empty()) &&
      column.group != table.columns[i - 1].group)
    names += " first";
  return names;
}

std::string cell_html(const Table& table, size_t i, const Cell& cell, Notes& notes) {
  const Column& column = table.columns[i];
  std::string content = cell.value.is_number()   ? number_text(cell.value, column.digits)
                        : cell.value.is_string() ? breakable(cell.value.get<std::string>())
                                                 : "<span class=\"none\">\u2013</span>";
  if (!cell.note.empty()) {
    const std::string mark = notes.mark(cell.note);
    content +=
        fmt::format("<a class=\"mark\" href=\"#{}-{}\" title=\"{}\">{}</a>", table.id, mark, escaped(cell.note), mark);
  }
  const std::string value =
      cell.value.is_number() ? fmt::format(" data-value=\"{}\"", json_text(cell.value)) : std::string();
  // A name at the left end heads its row.
  if (i == 0 && column.left) return fmt::format("<th scope=\"row\" class=\"text\"><span>{}</span></th>", content);
  return fmt::format("<td class=\"{}\"{}>{}</td>", classes(table, i), value, content);
}

std::string rows_html(const Table& table, const std::vector<Row>& rows, Notes& notes) {
  std::string html;
  for (const Row& row : rows) {
    html += "<tr>";
    for (size_t i = 0; i < row.size(); ++i) html += cell_html(table, i, row[i], notes);
    html += "</tr>\n";
  }
  return html;
}

/// One line of column heads, or two where columns are grouped.
std::string head_html(const Table& table) {
  const std::vector<Column>& columns = table.columns;
  const bool grouped = std::any_of(columns.begin(), columns.end(), [](const Column& c) { return !c.group.empty(); });
  std::string upper, lower;
  for (size_t i = 0; i < columns.size(); ++i) {
    const Column& column = columns[i];
    std::string below =
        column.unit.empty() ? std::string() : fmt::format("<span class=\"unit\">{}</span>", escaped(column.unit));
    if (column.source == Source::paper && column.name != "paper") below += "<span class=\"source\">paper</span>";
    const std::string head = fmt::format(
        "<th scope=\"col\" class=\"{}\" aria-sort=\"none\"{}><button type=\"button\">{}</button><span "
        "class=\"below\">{}</span></th>",
        classes(table, i), grouped && column.group.empty() ? " rowspan=\"2\"" : "", escaped(column.name), below);
    if (!grouped || column.group.empty()) {
      upper += head;
      continue;
    }
    lower += head;
    if (i > 0 && columns[i - 1].group == column.group) continue;
    size_t end = i;
    while (end < columns.size() && columns[end].group == column.group) ++end;
    upper += fmt::format("<th scope=\"colgroup\" class=\"group first\" colspan=\"{}\">{}</th>", end - i,
                         escaped(column.group));
  }
  return fmt::format("<thead>\n<tr>{}</tr>\n{}</thead>\n", upper,
                     grouped ? fmt::format("<tr>{}</tr>\n", lower) : std::string());
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_heading(const Column& column) {
  std::string text = column.group.empty() ? column.name : column.group + ": " + column.name;
  if (!column.unit.empty()) text += " (" + column.unit + ")";
  if (column.source != Source::none) text += std::string(" [") + word(column.source) + "]";
  return text;
}

nlohmann::json axis_json(const Axis& axis) {
  static constexpr const char* scales[] = {"linear", "log", "category"};
  return {{"label", axis.label},
          {"unit", axis.unit},
          {"scale", scales[int(axis.scale)]},
          {"digits", axis.digits ? nlohmann::json(*axis.digits) : nlohmann::json()}};
}

nlohmann::json values_json(const Series::Values& values) {
  nlohmann::json json = nlohmann::json::array();
  for (const std::optional<double>& value : values) json.push_back(value ? nlohmann::json(*value) : nlohmann::json());
  return json;
}

nlohmann::json plot_json(const Plot& plot) {
  static constexpr const char* kinds[] = {"line", "bars", "stacked"};
  nlohmann::json json{{"id", plot.id},
                      {"kind", kinds[int(plot.kind)]},
                      {"title", plot.title},
                      {"x", axis_json(plot.x)},
                      {"y", axis_json(plot.y)},
                      {"software", plot.software},
                      {"series", nlohmann::json::array()}};
  json["x"]["values"] = plot.x_values;
  for (const Series& series : plot.series) {
    nlohmann::json one{{"name", series.name},
                       {"paper", series.source == Source::paper},
                       {"stack", series.stack},
                       {"values", values_json(series.values)}};
    if (!series.low.empty()) {
      one["low"] = values_json(series.low);
      one["high"] = values_json(series.high);
    }
    json["series"].push_back(one);
  }
  return json;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      case '\t':
      case '\n':
        html += c;
        break;
      default:
        html += (c >= 0 && c < 0x20) || c == 0x7f ? "\uFFFD" : std::string(1, c);
    }
  return html;
}

std::string prose(std::string_view text) {
  std::string html;
  for (;;) {
    const size_t open = text.find('`');
    const size_t close = open == text.npos ? open : text.find('`', open + 1);
    if (close == text.npos) return html + escaped(text);
    html += escaped(text.substr(0, open)) + "<code>" + escaped(text.substr(open + 1, close - open - 1)) + "</code>";
    text.remove_prefix(close + 1);
  }
}

std::string number_text(const nlohmann::json& number, std::optional<int> digits) {
  std::string text;
  if (number.is_number_integer() && digits.value_or(0) == 0) {
    text = json_text(number);
  } else {
    const double value = number.get<double>();
    if (digits)
      text = fmt::format("{:.{}f}", value, *digits);
    else if (std::abs(value) >= 1e5 && std::abs(value) < 1e15)  // six digits or more before the point
      text = fmt::format("{:.0f}", value);
    else
      text = fmt::format("{:.6g}", value);
  }
  const bool negative = text.starts_with('-');
  if (negative) text.erase(0, 1);
  if (text.find('e') == text.npos)
    for (size_t at = std::min(text.find('.'), text.size()); at > 3; at -= 3) text.insert(at - 3, ",");
  const bool zero = text.find_first_of("123456789") == text.npos;
  return (negative && !zero ? "\u2212" : "") + text;
}

std::string script_json(const nlohmann::json& json) {
  std::string text;
  for (const char c : json_text(json)) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

std::string csv(const Table& table) {
  std::vector<Row> rows = table.rows;
  rows.insert(rows.end(), table.summary.begin(), table.summary.end());
  const bool notes = std::any_of(rows.begin(), rows.end(), [](const Row& row) {
    return std::any_of(row.begin(), row.end(), [](const Cell& cell) { return !cell.note.empty(); });
  });
  std::vector<std::string> line;
  for (const Column& column : table.columns) line.push_back(csv_field(csv_heading(column)));
  if (notes) line.push_back("notes");
  std::string text = fmt::format("{}\r\n", fmt::join(line, ","));
  for (const Row& row : rows) {
    line.clear();
    std::vector<std::string> remarks;
    for (size_t i = 0; i < row.size(); ++i) {
      const Cell& cell = row[i];
      line.push_back(cell.value.is_string() ? csv_field(cell.value.get<std::string>())
                     : cell.value.is_null() ? std::string()
                                            : json_text(cell.value));
      if (!cell.note.empty()) remarks.push_back(csv_heading(table.columns[i]) + ": " + cell.note);
    }
    if (notes) line.push_back(csv_field(fmt::format("{}", fmt::join(remarks, "; "))));
    text += fmt::format("{}\r\n", fmt::join(line, ","));
  }
  return text;
}

std::string software_badge() {
  return "<span class=\"software\" title=\"Measured on software OpenGL, not on a GPU\">software GL</span>";
}

std::string table_html(const Table& table) {
  Notes notes;
  const std::string head = head_html(table);
  const std::string body = rows_html(table, table.rows, notes);
  const std::string foot = rows_html(table, table.summary, notes);
  return fmt::format(
      "<div class=\"box\" tabindex=\"0\" role=\"region\" aria-labelledby=\"{0}-caption\">"
      "<table class=\"data\" id=\"{0}-table\" aria-labelledby=\"{0}-caption\">\n"
      "{1}<tbody>\n{2}</tbody>\n{3}</table></div>\n{4}"
      "<p class=\"save\"><a download=\"{0}.csv\" href=\"data:text/csv;charset=utf-8;base64,{5}\">{0}.csv</a></p>\n",
      table.id, head, body, foot.empty() ? foot : "<tfoot>\n" + foot + "</tfoot>\n", notes.html(table.id),
      base64(csv(table)));
}

std::string facts_html(const std::vector<Fact>& facts) {
  if (facts.empty()) return {};
  std::string html = "<dl class=\"facts\">\n";
  for (const Fact& fact : facts)
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(fact.name), prose(fact.value));
  return html + "</dl>\n";
}

std::string plot_html(const Plot& plot, bool with_plots) {
  const std::string drawing =
      with_plots
          ? fmt::format(
                "<noscript><p class=\"absent\">The plot takes JavaScript; its values are below.</p></noscript>\n"
                "<script type=\"application/json\">{}</script>\n",
                script_json(plot_json(plot)))
          : "<p class=\"absent\">The plot is not drawn: this build of izb has no d3. Its values are below.</p>\n";
  return fmt::format(
      "<figure class=\"plot {}\" id=\"{}-plot\">\n<figcaption><span class=\"title\">{}</span> {}{}</figcaption>\n{}"
      "<details class=\"values\"><summary id=\"{}-caption\">Values</summary>\n{}</details>\n</figure>\n",
      plot.kind == PlotKind::line ? "line" : "bars", plot.id, escaped(plot.title),
      plot.software ? software_badge() : "",
      plot.caption.empty() ? std::string() : fmt::format("<p>{}</p>", prose(plot.caption)), drawing,
      plot.id + "-values", table_html(table_of(plot)));
}

}  // namespace izb::report

// SPDX-License-Identifier: MIT
#include "app/bench/report.h"

#include <algorithm>
#include <cmath>

#include "app/bench/report_assets.h"
#include "app/bench/report_html.h"
#include "base/base64.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "image/png.h"

namespace izb::report {
namespace {

/// The images of a figure, whole in the page.
std::string pictures_html(const Pictures& pictures, const std::filesystem::path& folder) {
  std::string panes;
  int first_width_px = 0, first_height_px = 0;
  for (const Picture& picture : pictures.files) {
    const std::filesystem::path path = folder / picture.file;
    const std::vector<std::byte> bytes = read_binary_file(path);
    const Image8 image = read_png(bytes, path.string());  // a damaged one is told here, not by a browser's empty box
    if (panes.empty()) {
      first_width_px = image.width_px;
      first_height_px = image.height_px;
    }
    // A pixel more or less is what scaling rounds.
    const double expected_px = double(image.width_px) * first_height_px / first_width_px;
    if (std::abs(expected_px - image.height_px) > 1.0)
      fail("'{}' ({} x {}) is shown beside an image of another aspect ratio ({} x {})", path.string(), image.width_px,
           image.height_px, first_width_px, first_height_px);
    panes += fmt::format(
        "<figure><div class=\"pane\" style=\"aspect-ratio: {0} / {1}\"><img src=\"data:image/png;base64,{2}\" "
        "width=\"{0}\" "
        "height=\"{1}\" alt=\"{3}: {4}\" draggable=\"false\" "
        "decoding=\"async\"></div><figcaption>{4}</figcaption></figure>\n",
        image.width_px, image.height_px, base64(bytes), escaped(pictures.title), escaped(picture.label));
  }
  return fmt::format(
      "<figure class=\"images{}\">\n<figcaption><span class=\"title\">{}</span>{}</figcaption>\n"
      "<div class=\"panes\" style=\"--count: {}\">\n{}</div>\n</figure>\n",
      pictures.pixelated ? " pixelated" : "", escaped(pictures.title),
      pictures.caption.empty() ? std::string() : fmt::format("<p>{}</p>", prose(pictures.caption)),
      pictures.files.size(), panes);
}

std::string section_html(const Section& section, const std::filesystem::path& folder, bool with_plots) {
  std::string html = fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\"><a href=\"#{0}\">{1}</a>{2}</h2>\n",
      section.id, escaped(section.title), section.software ? " " + software_badge() : "");
  for (const std::string& paragraph : section.text) html += fmt::format("<p>{}</p>\n", prose(paragraph));
  html += facts_html(section.facts);
  for (const Table& table : section.tables)
    html += fmt::format(
        "<figure class=\"table{}\">\n<figcaption id=\"{}-caption\"><span "
        "class=\"title\">{}</span>{}</figcaption>\n{}</figure>\n",
        table.columns.size() > 18  ? " wide broad"
        : table.columns.size() > 9 ? " wide"
                                   : "",
        table.id, prose(table.caption), table.software ? " " + software_badge() : "", table_html(table));
  if (!section.plots.empty()) {
    html += "<div class=\"plots\">\n";
    for (const Plot& plot : section.plots) html += plot_html(plot, with_plots);
    html += "</div>\n";
  }
  for (const Pictures& pictures : section.images) html += pictures_html(pictures, folder);
  if (!section.notes.empty()) {
    html += "<ul class=\"notes\">\n";
    for (const std::string& note : section.notes) html += fmt::format("<li>{}</li>\n", prose(note));
    html += "</ul>\n";
  }
  return html + "</section>\n";
}

std::string contents_html(const Document& document) {
  std::string html;
  for (const Section& section : document.sections)
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escaped(section.title));
  return fmt::format("<nav aria-label=\"Contents\">\n<h2>Contents</h2>\n<ol>\n{}</ol>\n</nav>\n", html);
}

/// A script of our own or of d3's: a closing tag within it would end it.
std::string script_html(const std::string& script) {
  if (script.find("</script") != std::string::npos) fail("a script of the report holds the text that ends a script");
  return "<script>\n" + script + "</script>\n";
}

std::string head_of_page(const Document& document, const Assets& assets) {
  // The policy makes the browser itself refuse whatever would come from elsewhere.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'; "
      "script-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n{}</style>\n{}</head>\n",
      escaped(document.title), assets.styles, script_html(assets.theme));
}

/// The page of a document whose strings are UTF-8.
std::string page(const Document& document, const std::filesystem::path& folder) {
  const Assets assets = read_assets();
  std::string html = head_of_page(document, assets);
  html += fmt::format(
      "<body>\n<div class=\"page\">\n{}<main>\n<header>\n<button type=\"button\" class=\"theme\" "
      "hidden>Dark</button>\n<h1>{}</h1>\n",
      contents_html(document), escaped(document.title));
  if (!document.subtitle.empty()) html += fmt::format("<p class=\"subtitle\">{}</p>\n", prose(document.subtitle));
  if (document.software)
    html += fmt::format(
        "<p class=\"warning\">{} These times are of a software renderer on the processor, not of a GPU.</p>\n",
        software_badge());
  html += facts_html(document.facts) + "</header>\n";
  for (const Section& section : document.sections) html += section_html(section, folder, !assets.d3.empty());
  html += "</main>\n</div>\n";
  const bool plots = std::any_of(document.sections.begin(), document.sections.end(),
                                 [](const Section& section) { return !section.plots.empty(); });
  if (plots && !assets.d3.empty())
    html += "<!-- The licence of d3:\n\n" + assets.d3_licence + "-->\n" + script_html(assets.d3);
  return html + script_html(assets.scripts) + "</body>\n</html>\n";
}

}  // namespace
}  // namespace izb::report

namespace izb {

std::string make_report(const nlohmann::json& document, const std::filesystem::path& folder) {
  // As text and back: strings are UTF-8 then, and numbers finite.
  return report::page(report::read_document(nlohmann::json::parse(json_text(document))), folder);
}

}  // namespace izb

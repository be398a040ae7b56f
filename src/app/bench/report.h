// SPDX-License-Identifier: MIT
// The report of a benchmark: one HTML file that needs nothing else, made from a JSON document.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace izb {

/// One self-contained HTML page: styles, scripts, d3 and images are in it, and it asks no network for anything. It
/// reads from a file, light and dark, at any width, and printed; text and tables also without JavaScript. Where the
/// build has no d3 the page says so in place of each plot; the plot's values are there as a table either way.
///
/// The document, in which [] marks what may be left out, and a key that is not named here is an error:
///
///     {"title", ["subtitle"], ["facts"], ["software"], "sections": [SECTION, ...]}
///     SECTION  {"id", "title", ["text": [TEXT]], ["facts"], ["notes": [TEXT]], ["software"],
///               ["tables": [TABLE]], ["plots": [PLOT]], ["images": [IMAGES]]}
///     TABLE    {"id", "caption", "columns": [COLUMN], "rows": [[CELL]], ["summary": [[CELL]]], ["software"],
///     ["empty"]} COLUMN   {"name", ["unit"], ["digits"], ["align": "left"|"right"], ["source": "measured"|"paper"],
///     ["group"],
///               ["empty"]}
///     CELL     number | string | null | {"reason"} | {"value", "note"}
///     PLOT     {"id", "title", "kind": "line"|"bars"|"stacked", "x": AXIS, "y": AXIS, "series": [SERIES],
///     ["software"],
///               ["caption"]}
///     AXIS     {["label"], ["unit"], ["scale": "linear"|"log"|"category"], of x: "values", of y: ["digits"]}
///     SERIES   {"name", ["source"], "values": [number|null], ["low"], ["high"], ["stack"], ["software"]}
///     IMAGES   {"title", ["caption"], "files": [{"file", "label"}], ["pixelated"]}
///
/// - "facts": pairs of strings, e.g. ["machine", "..."]. "subtitle", "caption", TEXT and the second of a fact may hold
///   `code` between backticks.
/// - "id": letters, digits, '-' and '_', unique among the sections, or else among the tables and plots. A section's is
/// its
///   anchor; ID.csv and ID.svg are the files that a reader saves, ID-values.csv for the values of a plot.
/// - "software": measured on software GL; it is then marked. What does not say takes it from what it stands in.
/// - "digits": behind the point; without it whole numbers are whole and others have up to six significant digits.
/// - "group": a heading over neighbouring columns of the same group. "summary": rows below all others, however sorted.
/// - A cell without a value needs a reason, which is printed below the table: {"reason": "timed out after 300 s"}, or
///   null where its column or else its table says in "empty" why. "note": the same beside a value.
/// - "line": the x values are numbers (linear, log) or strings (category). "bars" and "stacked" draw a group of
///   horizontal bars for each category. Series of one name have one colour; those of the paper are dashed or hatched. A
///   null is a gap. "low" and "high" bound the spread. Bars of one "stack" are laid end to end (default: of one
///   source).
/// - The files of one IMAGES are PNGs of one aspect ratio, named relative to `folder`, shown side by side and zoomed
///   together. "pixelated": pixels stay squares.
///
/// Text is UTF-8; bytes that are not become U+FFFD, and numbers that are not finite count as null.
/// Throws izb::Error, one sentence, for a document that does not fit and for a missing or damaged image;
/// std::logic_error if a plot's measured series differ in "software": times of software GL and of a GPU never stand in
/// one plot.
std::string make_report(const nlohmann::json& document, const std::filesystem::path& folder);

}  // namespace izb

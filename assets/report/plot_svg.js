// SPDX-License-Identifier: MIT
// A plot as an SVG file that stands alone, with its title and legend, in the colours of the page as it is.
"use strict";
(function () {
  const properties = ["display", "shape-rendering", "fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "opacity", "font-family",
    "font-size", "font-weight", "font-variant-numeric", "paint-order", "stroke-linejoin"];

  /// What the page's styles make of an element becomes its own.
  function copyStyles(from, to) {
    const style = getComputedStyle(from);
    to.removeAttribute("class");
    for (const property of properties) to.style.setProperty(property, style.getPropertyValue(property));
    for (let i = 0; i < from.children.length; ++i) copyStyles(from.children[i], to.children[i]);
  }

  izb.svgText = function (plot, svg) {
    const copy = svg.cloneNode(true);
    copyStyles(svg, copy);
    const ink = getComputedStyle(document.body).color, ground = getComputedStyle(svg).getPropertyValue("--surface");
    const font = getComputedStyle(document.body).fontFamily;
    const result = d3.create("svg").attr("xmlns", "http://www.w3.org/2000/svg").style("font-family", font);
    const paper = result.append("rect").attr("fill", ground);
    const write = (x, y, text, size, weight) =>
      result.append("text").attr("x", x).attr("y", y).attr("font-size", size).attr("font-weight", weight).attr("fill", ink).text(text);
    write(10, 24, plot.title + (plot.data.software ? " (software GL)" : ""), 15, 600);
    let x = 10, y = 48;
    for (const button of plot.names.filter((name) => !plot.hidden.has(name))) {
      const own = plot.data.series.filter((series) => series.name === button);
      const width = plot.data.kind === "line" ? 30 : 12, text = izb.textWidth(button, 12);
      if (x > 10 && x + width + 6 + text > plot.width) {
        x = 10;
        y += 20;
      }
      const swatch = izb.swatch(plot, button, own.every((series) => series.paper), width);
      document.body.append(swatch);  // styles are computed for what is in the page
      const drawn = swatch.cloneNode(true);
      copyStyles(swatch, drawn);
      swatch.remove();
      result.append(() => drawn).attr("x", x).attr("y", y - 10);
      write(x + width + 6, y, button, 12, 400);
      x += width + 24 + text;
    }
    if (plot.data.series.some((series) => series.paper)) {
      y += 20;
      write(10, y, `${plot.data.kind === "line" ? "dashed, hollow" : "hatched"}: the paper's values`, 12, 400);
    }
    const height = y + 16 + plot.geometry.height + 8;
    d3.select(copy).attr("x", 10).attr("y", y + 16).attr("tabindex", null).selectAll(".cursor, .selection").remove();
    result.append(() => copy);
    result.attr("viewBox", `0 0 ${plot.width + 20} ${height}`).attr("width", plot.width + 20).attr("height", height);
    paper.attr("width", plot.width + 20).attr("height", height);
    return new XMLSerializer().serializeToString(result.node());
  };

  izb.saveSvg = function (plot, svg) {
    const link = izb.element("a");
    link.href = URL.createObjectURL(new Blob([izb.svgText(plot, svg)], {type: "image/svg+xml"}));
    link.download = `${plot.data.id}.svg`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };
})();

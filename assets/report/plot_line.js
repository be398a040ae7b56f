// SPDX-License-Identifier: MIT
// Line plots: values over numbers or categories, with bands of spread and gaps.
"use strict";

/// The line of a series: the paper's is dashed.
izb.linePath = (path, color, paper) =>
  path.attr("class", "line").style("stroke", color).style("stroke-dasharray", paper ? "6 4" : "none");

/// The symbol of a name, hollow for the paper's.
izb.lineSymbol = function (path, plot, name, paper) {
  const shapes = [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, d3.symbolCross, d3.symbolStar, d3.symbolWye];
  const color = plot.color(name);
  return path.attr("class", "symbol").attr("d", d3.symbol().type(shapes[plot.names.indexOf(name) % shapes.length]).size(44)())
    .style("stroke", color).style("fill", paper ? "var(--surface)" : color);
};

(function () {
  const size = 12;  // of the text, px

  /// From 0 on where the scale is linear, so that heights compare.
  function yDomain(plot) {
    const shown = plot.visible().length ? plot.visible() : plot.data.series;
    const all = shown.flatMap((series) => [...series.values, ...(series.low || []), ...(series.high || [])]).filter((v) => v !== null);
    const [low, high] = all.length ? d3.extent(all) : [1, 10];
    if (plot.data.y.scale === "log") {
      const factor = Math.max(Math.pow(high / low, 0.06), 1.15);
      return [low / factor, high * factor];
    }
    const room = 0.06 * (Math.max(high, 0) - Math.min(low, 0)) || 1;
    return [low < 0 ? low - room : 0, high > 0 ? high + room : 0];
  }

  function xDomain(axis) {
    if (axis.scale === "category") return [-0.5, axis.values.length - 0.5];
    const [low, high] = d3.extent(axis.values);
    if (axis.scale === "log") {
      const room = low === high ? 2 : Math.pow(high / low, 0.03);
      return [low / room, high * room];
    }
    const room = 0.02 * (high - low) || 1;
    return [low - room, high + room];
  }

  /// The x values to write: those that were measured if they are few, and never two on top of each other.
  function xTicks(axis, scale, width, text) {
    const own = axis.scale === "category" ? d3.range(axis.values.length)
      : axis.values.length <= 12 ? axis.values : izb.ticks(scale, axis.scale, width / 90);
    const [from, to] = scale.domain();
    let end = -Infinity;
    return own.filter((value) => {
      if (value < from || value > to) return false;
      const half = izb.textWidth(text(value), size) / 2 + 5, at = scale(value);
      if (at - half < end) return false;
      end = at + half;
      return true;
    });
  }

  izb.drawLine = function (plot, svg) {
    const {x, y, series: all} = plot.data;
    const category = x.scale === "category";
    const top = 26, height = Math.round(Math.min(Math.max(0.55 * plot.width, 250), 400));

    // How much room the names below take: level if they fit, else at a slant.
    const names = category ? x.values.map((name) => izb.shortened(name, 130, size)) : [];
    const widest = category ? d3.max(names, (name) => izb.textWidth(name, size)) : 0;
    const slanted = category && widest > (plot.width - 60) / names.length - 8;
    const bottom = (slanted ? 14 + 0.6 * widest : 24) + (x.label ? 20 : 0);

    const area = {top, height: Math.max(height - top - bottom, 150)};
    const yScale = izb.scale(y.scale, yDomain(plot), [area.height, 0], plot.view.y);
    const yTicks = izb.ticks(yScale, y.scale, area.height / 48);
    area.left = Math.max(d3.max(yTicks, (value) => izb.textWidth(izb.tickText(value), size)) + 14,
      slanted ? 0.8 * izb.textWidth(names[0], size) - (plot.width - 60) / names.length / 2 : 0);
    area.width = plot.width - area.left - 12;
    const xScale = izb.scale(category ? "linear" : x.scale, xDomain(x), [0, area.width], plot.view.x);
    const position = (index) => xScale(category ? index : x.values[index]);

    const clip = `${plot.data.id}-clip`;
    svg.append("clipPath").attr("id", clip).append("rect").attr("width", area.width).attr("height", area.height);
    const root = svg.append("g").attr("transform", `translate(${area.left},${area.top})`);
    root.append("g").attr("class", "grid").selectAll("line").data(yTicks).enter().append("line")
      .attr("x2", area.width).attr("y1", yScale).attr("y2", yScale);
    root.append("g").attr("class", "axis").call(d3.axisLeft(yScale).tickValues(yTicks).tickFormat(izb.tickText).tickSize(0).tickPadding(8))
      .selectAll("line").remove();
    const text = (value) => (category ? names[value] : izb.tickText(value));
    const ticks = slanted ? d3.range(names.length).filter((i) => i >= xScale.domain()[0] && i <= xScale.domain()[1])
      : xTicks(x, xScale, area.width, text);
    const below = root.append("g").attr("class", "axis baseline").attr("transform", `translate(0,${area.height})`)
      .call(d3.axisBottom(xScale).tickValues(ticks).tickFormat(text).tickSize(5).tickSizeOuter(0));
    if (slanted) below.selectAll("text").attr("transform", "rotate(-37)").attr("text-anchor", "end").attr("dx", "-0.6em").attr("dy", "0.2em");
    svg.append("text").attr("class", "label").attr("x", 0).attr("y", 12).text(izb.withUnit(y));
    if (x.label)
      svg.append("text").attr("class", "label").attr("x", area.left + area.width / 2).attr("y", area.top + area.height + bottom - 4)
        .attr("text-anchor", "middle").text(izb.withUnit(x));

    const inside = root.append("g").attr("clip-path", `url(#${clip})`);
    const marks = x.values.length <= 40;
    for (const series of all) if (!plot.hidden.has(series.name)) drawSeries(plot, inside, series, position, yScale, marks);

    const [from, to] = xScale.range();
    return {
      area, height: area.top + area.height + bottom, axes: ["x", "y"],
      pick(px, py) {
        if (py < 0 || px < area.left - 10) return null;
        const near = d3.range(x.values.length).filter((i) => position(i) >= from && position(i) <= to);
        return near.length ? near[d3.scan(near, (a, b) => Math.abs(position(a) + area.left - px) - Math.abs(position(b) + area.left - px))] : null;
      },
      showCursor(index) {
        const cursor = inside.append("g").attr("class", "cursor");
        cursor.append("line").attr("x1", position(index)).attr("x2", position(index)).attr("y2", area.height);
        for (const series of plot.visible())
          if (series.values[index] !== null)
            cursor.append("circle").attr("cx", position(index)).attr("cy", yScale(series.values[index])).attr("r", 6).style("stroke", plot.color(series.name));
        return {x: area.left + position(index), y: area.top + 4};
      },
    };
  };

  function drawSeries(plot, parent, series, position, yScale, marks) {
    const indices = d3.range(series.values.length), color = plot.color(series.name);
    const there = (i) => i >= 0 && i < series.values.length && series.values[i] !== null;
    const group = parent.append("g").attr("class", "series");
    if (series.low) {
      const spread = (i) => there(i) && series.low[i] !== null && series.high[i] !== null;
      group.append("path").attr("class", "band").style("fill", color)
        .attr("d", d3.area().defined(spread).x(position).y0((i) => yScale(series.low[i])).y1((i) => yScale(series.high[i]))(indices));
      group.selectAll("line").data(indices.filter((i) => spread(i) && !spread(i - 1) && !spread(i + 1))).enter().append("line")
        .attr("class", "whisker").style("stroke", color).attr("x1", position).attr("x2", position)
        .attr("y1", (i) => yScale(series.low[i])).attr("y2", (i) => yScale(series.high[i]));
    }
    izb.linePath(group.append("path"), color, series.paper)
      .attr("d", d3.line().defined(there).x(position).y((i) => yScale(series.values[i]))(indices));
    // A value between two gaps has no line.
    const marked = indices.filter((i) => there(i) && (marks || (!there(i - 1) && !there(i + 1))));
    for (const i of marked)
      izb.lineSymbol(group.append("path"), plot, series.name, series.paper).attr("transform", `translate(${position(i)},${yScale(series.values[i])})`);
  }
})();

// SPDX-License-Identifier: MIT
// Horizontal bars, one a series beside each other or laid end to end, a group for each category.
"use strict";

/// The area of a bar: the paper's is hatched. `id` is unique to the svg's pattern.
izb.barFill = function (shape, svg, id, color, paper) {
  shape.attr("class", "bar").style("stroke", paper ? color : "none");
  if (!paper) return shape.style("fill", color);
  const pattern = svg.append("pattern").attr("id", id).attr("width", 6).attr("height", 6).attr("patternUnits", "userSpaceOnUse")
    .attr("patternTransform", "rotate(45)");
  pattern.append("rect").attr("class", "paper-ground").attr("width", 6).attr("height", 6);
  pattern.append("rect").attr("width", 2.5).attr("height", 6).style("fill", color);
  return shape.style("fill", `url(#${id})`);
};

(function () {
  const size = 12, small = 11;  // of the text, px

  /// The bars of a category: [{label, value, end, low, high, parts: [{series, from, to}], missing}].
  function barsOf(plot, index) {
    const visible = plot.visible();
    if (plot.data.kind === "bars")
      return visible.map((series) => {
        const value = series.values[index];
        return {series, value, end: value, low: series.low && series.low[index], high: series.low && series.high[index],
          parts: value === null ? [] : [{series, from: 0, to: value}]};
      });
    const stacks = Array.from(new Set(visible.map((series) => series.stack)));
    return stacks.map((label) => {
      let end = 0;
      const parts = [], missing = [];
      for (const series of visible.filter((one) => one.stack === label)) {
        if (series.values[index] === null) missing.push(series.name);
        else parts.push({series, from: end, to: (end += series.values[index])});
      }
      return {label, value: parts.length ? end : null, end, parts, missing};
    });
  }

  function domain(plot, bars) {
    const ends = bars.flat().flatMap((bar) => [bar.end, bar.low, bar.high]).filter((v) => v !== null && v !== undefined);
    const [low, high] = ends.length ? d3.extent(ends) : [1, 10];
    if (plot.data.y.scale === "log") return [Math.pow(10, Math.floor(Math.log10(low / 1.5))), high];
    return low === high && high === 0 ? [0, 1] : [Math.min(low, 0), Math.max(high, 0)];
  }

  izb.drawBars = function (plot, svg) {
    const {x, y} = plot.data;
    const bars = x.values.map((_, index) => barsOf(plot, index));
    const count = Math.max(bars[0].length, 1);
    const stacked = plot.data.kind === "stacked" && count > 1;  // then each bar says what it is
    const thickness = [18, 14, 12][count - 1] || 10;
    const narrow = plot.width < 560;
    const labelWidth = d3.max(x.values, (name) => izb.textWidth(name, size));
    const subWidth = stacked ? d3.max(bars[0], (bar) => izb.textWidth(bar.label, small)) + 8 : 0;
    const shownLabel = Math.min(labelWidth, narrow ? plot.width - 8 : 0.34 * plot.width);
    const head = narrow ? 18 : 0, pitch = thickness + 2, gap = narrow || count > 1 ? 12 : 8;
    const row = head + count * pitch - 2 + gap;

    // A sum that lacks a part says so: it is not the whole.
    const valueText = (bar) => plot.valueText(bar.value) +
      (bar.value !== null && bar.missing && bar.missing.length ? ` without ${bar.missing.join(", ")}` : "");
    const extent = domain(plot, bars);
    const values = d3.max(bars.flat(), (bar) => (bar.missing && bar.missing.length ? 0 : izb.textWidth(valueText(bar), small))) || 0;
    const area = {top: x.label ? 24 : 8, left: Math.round((narrow ? 0 : shownLabel) + subWidth + (narrow && !stacked ? 2 : 10))};
    area.width = plot.width - area.left - 10;
    area.height = x.values.length * row;
    // Room for the values that are written beyond the bars' ends.
    const left = extent[0] < 0 ? values + 10 : 0, right = values + 12;
    const whole = izb.scale(y.scale, extent, [left, area.width - right], [0, 1]);
    const scale = izb.scale(y.scale, [whole.invert(0), whole.invert(area.width)], [0, area.width], plot.view.x);
    const base = y.scale === "log" ? scale.domain()[0] : 0;
    const ticks = izb.ticks(scale, y.scale, area.width / 90);

    const clip = `${plot.data.id}-clip`;
    svg.append("clipPath").attr("id", clip).append("rect").attr("x", -1).attr("y", -4).attr("width", area.width + 2).attr("height", area.height + 4);
    if (x.label) svg.append("text").attr("class", "label").attr("x", 0).attr("y", 12).text(izb.withUnit(x));
    const root = svg.append("g").attr("transform", `translate(${area.left},${area.top})`);
    root.append("g").attr("class", "grid").selectAll("line").data(ticks).enter().append("line")
      .attr("x1", scale).attr("x2", scale).attr("y1", -4).attr("y2", area.height);
    root.append("g").attr("class", "axis").attr("transform", `translate(0,${area.height})`)
      .call(d3.axisBottom(scale).tickValues(ticks).tickFormat(izb.tickText).tickSize(0).tickPadding(6))
      .selectAll("line").remove();
    svg.append("text").attr("class", "label").attr("x", area.left + area.width / 2).attr("y", area.top + area.height + 38)
      .attr("text-anchor", "middle").text(izb.withUnit(y));

    const inside = root.append("g").attr("clip-path", `url(#${clip})`);
    const labels = svg.append("g");
    const patterns = new Set();
    bars.forEach((group, index) => {
      const y0 = index * row, middle = y0 + head + (count * pitch - 2) / 2;
      const label = labels.append("text").attr("class", "category").attr("x", narrow ? 0 : shownLabel).attr("y", area.top + (narrow ? y0 + 12 : middle))
        .attr("text-anchor", narrow ? "start" : "end").attr("dy", narrow ? 0 : "0.35em").text(izb.shortened(x.values[index], shownLabel, size));
      label.append("title").text(x.values[index]);
      group.forEach((bar, k) => drawBar(bar, y0 + head + k * pitch));
    });
    if (extent[0] < 0 || y.scale !== "log")
      inside.append("line").attr("class", "zero").attr("x1", scale(base)).attr("x2", scale(base)).attr("y1", -4).attr("y2", area.height);

    function drawBar(bar, top) {
      const group = inside.append("g").attr("class", "series");
      if (stacked)
        labels.append("text").attr("class", "stack").attr("x", area.left - 8).attr("y", area.top + top + thickness / 2).attr("dy", "0.35em")
          .attr("text-anchor", "end").text(bar.label);
      for (const part of bar.parts) {
        const ends = [scale(part.from === 0 ? base : part.from), scale(part.to)];
        const id = `${plot.data.id}-hatch-${plot.names.indexOf(part.series.name)}`;
        const shape = group.append("rect").attr("x", Math.min(...ends)).attr("width", Math.abs(ends[1] - ends[0])).attr("y", top).attr("height", thickness);
        izb.barFill(shape, patterns.has(id) ? d3.create("svg") : svg, id, plot.color(part.series.name), part.series.paper);
        if (part.series.paper) patterns.add(id);
      }
      const whiskers = bar.low !== null && bar.low !== undefined && bar.high !== null;
      if (whiskers) {
        const middle = top + thickness / 2, cap = Math.min(4, thickness / 2 - 1);
        const path = `M${scale(bar.low)},${middle}H${scale(bar.high)}M${scale(bar.low)},${middle - cap}v${2 * cap}M${scale(bar.high)},${middle - cap}v${2 * cap}`;
        for (const part of ["whisker-ground", "whisker on-bar"]) group.append("path").attr("class", part).attr("d", path);
      }
      const negative = bar.value !== null && bar.value < 0;
      const end = bar.value === null ? base : negative ? Math.min(bar.end, whiskers ? bar.low : bar.end) : Math.max(bar.end, whiskers ? bar.high : bar.end);
      group.append("text").attr("class", "value").attr("x", scale(end) + (negative ? -5 : 5)).attr("y", top + thickness / 2).attr("dy", "0.35em")
        .attr("text-anchor", negative ? "end" : "start").text(valueText(bar));
    }

    return {
      area, height: area.top + area.height + 46, axes: ["x"],
      pick(px, py) {
        const index = Math.floor((py - area.top) / row);
        return index >= 0 && index < x.values.length ? index : null;
      },
      showCursor(index) {
        root.insert("rect", ":first-child").attr("class", "cursor").attr("x", -area.left).attr("width", plot.width)
          .attr("y", index * row - gap / 2).attr("height", row);
        return {x: area.left + 0.45 * area.width, y: area.top + (index + 1) * row};
      },
    };
  };
})();

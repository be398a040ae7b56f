// SPDX-License-Identifier: MIT
// What every plot has around its drawing: legend, zoom, values under the pointer, buttons. plot_line.js and plot_bars.js
// draw; each returns what they drew where, the `geometry`.
"use strict";

/// Width of a text in px.
izb.textWidth = (function () {
  const context = document.createElement("canvas").getContext("2d");
  return function (text, size = 12) {
    context.font = `${size}px ${getComputedStyle(document.body).fontFamily}`;
    return context.measureText(text).width;
  };
})();

/// The text with its middle left out until it fits: names differ at their ends.
izb.shortened = function (text, width, size = 12) {
  if (izb.textWidth(text, size) <= width) return text;
  const letters = Array.from(text);
  for (let kept = letters.length - 1; kept > 2; --kept) {
    const short = letters.slice(0, Math.ceil(kept / 2)).join("") + "…" + letters.slice(letters.length - Math.floor(kept / 2)).join("");
    if (izb.textWidth(short, size) <= width) return short;
  }
  return "…";
};

izb.withUnit = (axis) => axis.label + (axis.unit ? ` (${axis.unit})` : "");

/// A number on an axis.
izb.tickText = function (value) {
  const size = Math.abs(value);
  const text = size >= 1e6 || (size > 0 && size < 1e-4) ? d3.format(".4~s")(value) : d3.format(",.6~r")(value);
  return text.replace("-", "−");
};

/// A scale over the whole domain, and the part of it that a view [from, to], in shares of its range, shows.
izb.scale = function (kind, domain, range, view) {
  const whole = (kind === "log" ? d3.scaleLog() : d3.scaleLinear()).domain(domain).range(range);
  const at = (share) => whole.invert(range[0] + share * (range[1] - range[0]));
  return whole.copy().domain([at(view[0]), at(view[1])]);
};

/// About `count` values to write on an axis.
izb.ticks = function (scale, kind, count) {
  if (kind !== "log") return scale.ticks(count);
  const [from, to] = scale.domain();
  const decades = d3.range(Math.floor(Math.log10(from)), Math.ceil(Math.log10(to)) + 1);
  for (const digits of [[1], [1, 3], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const all = decades.flatMap((decade) => digits.map((digit) => digit * Math.pow(10, decade)));
    const inside = all.filter((value) => value >= from * 0.9999 && value <= to * 1.0001);
    if (inside.length >= Math.min(count, 4)) return inside;
  }
  return d3.ticks(from, to, count);  // less than a decade is as good as linear
};

(function () {
  const colors = 8;
  let printing = false;  // then a plot is as wide as its place on A4, in px of CSS, whatever the window

  function setUp(figure) {
    const data = JSON.parse(figure.querySelector("script").textContent);
    const plot = {
      data,
      names: Array.from(new Set(data.series.map((series) => series.name))),
      hidden: new Set(),
      view: {x: [0, 1], y: [0, 1]},
      cursor: null,  // index of the x value that is shown
    };
    plot.color = (name) => `var(--c${plot.names.indexOf(name) % colors})`;
    plot.visible = () => data.series.filter((series) => !plot.hidden.has(series.name));
    // Counts are whole.
    const whole = data.series.every((series) => series.values.every((value) => Number.isInteger(value ?? 0)));
    plot.valueText = (value) => izb.number(value, data.y.digits ?? (whole ? 0 : null));
    plot.title = figure.querySelector(".title").textContent;

    const stage = izb.element("div", "stage");
    const svg = d3.create("svg").attr("tabindex", 0).attr("role", "img").attr("aria-label", plot.title);
    const tip = izb.element("div", "tip");
    tip.setAttribute("role", "status");
    tip.hidden = true;
    stage.append(svg.node(), tip);
    const tools = izb.element("div", "tools");
    const reset = addButton(tools, "Reset zoom", () => resetView());
    addButton(tools, "Save SVG", () => izb.saveSvg(plot, svg.node()));
    tools.append(izb.element("span", "hint", data.kind === "line"
      ? "drag: zoom · click, then wheel · shift-drag: move · double click: all"
      : "drag: zoom · click, then wheel · double click: all"));
    figure.querySelector("details").before(legend(plot, () => draw()), stage, tools);

    function draw() {
      plot.width = printing ? (data.kind === "line" ? 330 : 680) : Math.max(stage.clientWidth, 200);
      svg.selectAll("*").remove();
      plot.geometry = (data.kind === "line" ? izb.drawLine : izb.drawBars)(plot, svg);
      svg.attr("width", plot.width).attr("height", plot.geometry.height)
        .attr("viewBox", `0 0 ${plot.width} ${plot.geometry.height}`);
      reset.disabled = !zoomed();
      showCursor(plot.cursor);
    }
    let waiting = false;
    function drawSoon() {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        draw();
      });
    }

    const zoomed = () => plot.geometry.axes.some((axis) => plot.view[axis][0] > 0 || plot.view[axis][1] < 1);
    function resetView() {
      plot.view = {x: [0, 1], y: [0, 1]};
      drawSoon();
    }
    /// Shares of what is shown: from the left, from below.
    const shares = (x, y) => {
      const area = plot.geometry.area;
      return {x: (x - area.left) / area.width, y: 1 - (y - area.top) / area.height};
    };
    function setView(axis, from, to) {
      const size = Math.min(Math.max(to - from, 1e-4), 1);
      const start = Math.min(Math.max(from, 0), 1 - size);
      plot.view[axis] = [start, start + size];
      drawSoon();
    }
    draw();
    izb.gestures(svg.node(), {
      zoomed,
      reset: resetView,
      zoom(factor, x, y) {
        const share = shares(x, y);
        for (const axis of plot.geometry.axes) {
          const [from, to] = plot.view[axis], size = (to - from) / factor;
          const start = from + share[axis] * (to - from - size);
          setView(axis, start, start + size);
        }
      },
      pan(dx, dy) {
        const area = plot.geometry.area, shift = {x: -dx / area.width, y: dy / area.height};
        for (const axis of plot.geometry.axes) {
          const [from, to] = plot.view[axis];
          setView(axis, from + shift[axis] * (to - from), to + shift[axis] * (to - from));
        }
      },
      box(first, second, done) {
        const area = plot.geometry.area, axes = plot.geometry.axes;
        const a = shares(first.x, first.y), b = shares(second.x, second.y);
        svg.selectAll(".selection").remove();
        showCursor(null);
        const inside = (share) => Math.min(Math.max(share, 0), 1);
        const left = inside(Math.min(a.x, b.x)), right = inside(Math.max(a.x, b.x));
        const low = axes.includes("y") ? inside(Math.min(a.y, b.y)) : 0, high = axes.includes("y") ? inside(Math.max(a.y, b.y)) : 1;
        if (!done) {
          svg.append("rect").attr("class", "selection").attr("x", area.left + left * area.width).attr("width", (right - left) * area.width)
            .attr("y", area.top + (1 - high) * area.height).attr("height", (high - low) * area.height);
        } else if ((right - left) * area.width > 5 && (high - low) * area.height > 5) {
          const within = (axis, share) => plot.view[axis][0] + share * (plot.view[axis][1] - plot.view[axis][0]);
          const box = {x: [within("x", left), within("x", right)], y: [within("y", low), within("y", high)]};
          for (const axis of axes) setView(axis, ...box[axis]);
        }
      },
      hover: (x, y) => showCursor(plot.geometry.pick(x, y)),
      leave: () => showCursor(null),
      step(direction) {
        const count = data.x.values.length;
        showCursor(plot.cursor === null ? (direction > 0 ? 0 : count - 1) : Math.min(Math.max(plot.cursor + direction, 0), count - 1));
      },
    });

    function showCursor(index) {
      plot.cursor = index;
      svg.selectAll(".cursor").remove();
      tip.hidden = index === null || plot.visible().length === 0;
      if (tip.hidden) return;
      const anchor = plot.geometry.showCursor(index);
      fillTip(tip, plot, index);
      const space = 14, right = anchor.x + space + tip.offsetWidth <= plot.width;
      tip.style.left = `${right ? anchor.x + space : Math.max(0, anchor.x - space - tip.offsetWidth)}px`;
      tip.style.top = `${anchor.y}px`;
    }

    let width = 0;
    new ResizeObserver(() => {
      if (printing || Math.abs(stage.clientWidth - width) < 1) return;
      width = stage.clientWidth;
      drawSoon();
    }).observe(stage);
    addEventListener("beforeprint", draw);
    addEventListener("afterprint", drawSoon);
  }

  function addButton(parent, text, action) {
    const button = izb.element("button", "", text);
    button.type = "button";
    button.addEventListener("click", action);
    parent.append(button);
    return button;
  }

  /// The values at one x, of every series that is shown.
  function fillTip(tip, plot, index) {
    const {x, y} = plot.data;
    const heading = x.scale === "category" ? x.values[index]
      : `${x.label} ${izb.tickText(x.values[index])}${x.unit ? " " + x.unit : ""}`;
    const table = izb.element("table");
    for (const series of plot.visible()) {
      const row = table.insertRow();
      row.insertCell().append(swatch(plot, series.name, series.paper, 12));
      const named = plot.data.kind === "stacked" ? series.stack : series.paper && !/\bpaper\b/.test(series.name) ? "paper" : "";
      row.insertCell().textContent = series.name + (named ? ` (${named})` : "");
      const value = series.values[index];
      row.insertCell().textContent = plot.valueText(value) + (value !== null && y.unit ? " " + y.unit : "");
      if (series.low && series.low[index] !== null && series.high[index] !== null)
        row.insertCell().textContent = `${plot.valueText(series.low[index])} – ${plot.valueText(series.high[index])}`;
    }
    tip.replaceChildren(izb.element("strong", "", heading), table);
  }

  /// What a series looks like, small.
  function swatch(plot, name, paper, width) {
    const svg = d3.create("svg").attr("class", "swatch").attr("width", width).attr("height", 12).attr("aria-hidden", "true");
    if (plot.data.kind === "line") {
      izb.linePath(svg.append("path").attr("d", `M0,6H${width}`), plot.color(name), paper);
      if (width > 16) izb.lineSymbol(svg.append("path"), plot, name, paper).attr("transform", `translate(${width / 2},6)`);
    } else {
      const area = svg.append("rect").attr("x", 0.5).attr("y", 0.5).attr("width", width - 1).attr("height", 11);
      izb.barFill(area, svg, `${plot.data.id}-swatch-${plot.names.indexOf(name)}-${width}`, plot.color(name), paper);
    }
    return svg.node();
  }
  izb.swatch = swatch;

  /// A button a name, which hides and shows all series of that name; and what tells the paper's from ours.
  function legend(plot, changed) {
    const list = izb.element("div", "legend");
    const width = plot.data.kind === "line" ? 30 : 12;
    for (const name of plot.names) {
      const own = plot.data.series.filter((series) => series.name === name);
      const button = addButton(list, "", () => {
        if (!plot.hidden.delete(name)) plot.hidden.add(name);
        button.setAttribute("aria-pressed", String(!plot.hidden.has(name)));
        changed();
      });
      button.setAttribute("aria-pressed", "true");
      button.append(swatch(plot, name, own.every((series) => series.paper), width), name);
    }
    if (plot.data.series.some((series) => series.paper)) {
      const how = plot.data.kind === "line" ? "dashed, hollow" : "hatched";
      list.append(izb.element("span", "key", `${how}: the paper's values`));
    }
    return list;
  }

  addEventListener("beforeprint", () => { printing = true; });
  addEventListener("afterprint", () => { printing = false; });
  if (typeof d3 !== "undefined") document.querySelectorAll("figure.plot").forEach(setUp);
})();

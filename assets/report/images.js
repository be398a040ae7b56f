// SPDX-License-Identifier: MIT
// Images side by side: all show the same region, and where the pointer is in one is marked in the others.
"use strict";
(function () {
  function setUp(figure) {
    const panes = Array.from(figure.querySelectorAll(".pane"));
    const view = {scale: 1, x: 0, y: 0};  // the upper left corner of the region, in shares of the image

    const bar = izb.element("div", "tools");
    const hint = izb.element("span", "hint", "click, then wheel: zoom · drag: move · double click: all");
    const button = (text, label, action) => {
      const made = izb.element("button", "", text);
      made.type = "button";
      made.setAttribute("aria-label", label);
      made.addEventListener("click", action);
      bar.append(made);
      return made;
    };

    function show() {
      view.x = Math.min(Math.max(view.x, 0), 1 - 1 / view.scale);
      view.y = Math.min(Math.max(view.y, 0), 1 - 1 / view.scale);
      for (const pane of panes)
        pane.firstElementChild.style.transform =
          `translate(${-100 * view.x * view.scale}%, ${-100 * view.y * view.scale}%) scale(${view.scale})`;
      figure.classList.toggle("zoomed", view.scale > 1);
      reset.disabled = view.scale === 1;
    }
    function zoom(factor, fx, fy) {
      const scale = Math.min(Math.max(view.scale * factor, 1), 64);
      view.x += fx / view.scale - fx / scale;
      view.y += fy / view.scale - fy / scale;
      view.scale = scale;
      show();
    }
    function all() {
      Object.assign(view, {scale: 1, x: 0, y: 0});
      show();
    }
    function mark(from, x, y) {
      for (const pane of panes) {
        const cross = pane.querySelector(".cross");
        cross.hidden = from === null || pane === from;
        if (from) Object.assign(cross.style, {left: `${100 * x}%`, top: `${100 * y}%`});
      }
    }

    button("+", "Zoom in", () => zoom(2, 0.5, 0.5));
    button("−", "Zoom out", () => zoom(0.5, 0.5, 0.5));
    const reset = button("Whole image", "Show the whole image", all);
    bar.append(hint);
    figure.querySelector(".panes").before(bar);
    for (const pane of panes) {
      pane.tabIndex = 0;
      pane.setAttribute("role", "group");
      pane.setAttribute("aria-label", pane.firstElementChild.alt);
      const cross = izb.element("i", "cross");
      cross.hidden = true;
      pane.append(cross);
      izb.gestures(pane, {
        zoom: (factor, x, y) => zoom(factor, x / pane.clientWidth, y / pane.clientHeight),
        pan: (dx, dy) => {
          view.x -= dx / pane.clientWidth / view.scale;
          view.y -= dy / pane.clientHeight / view.scale;
          show();
        },
        reset: all,
        zoomed: () => view.scale > 1,
        hover: (x, y) => mark(pane, x / pane.clientWidth, y / pane.clientHeight),
        leave: () => mark(null),
      });
    }
    show();
  }

  document.querySelectorAll("figure.images").forEach(setUp);
})();

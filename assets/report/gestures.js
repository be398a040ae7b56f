// SPDX-License-Identifier: MIT
// Wheel, drag, pinch, double click and keys on an element, told as what they mean.
"use strict";

/// `on` has, with positions in pixels of `element`:
///   zoom(factor, x, y)  nearer by a factor about a point          pan(dx, dy)
///   reset()                                                      zoomed(): whether there is anything to pan
///   box(from, to, done) [optional] a box is being drawn by the mouse; done: it is let go
///   hover(x, y), leave(), step(direction) [optional]
/// The wheel scrolls the page until the element has the focus, by a click or a key, or Ctrl is held.
izb.gestures = function (element, on) {
  const pointers = new Map();
  let box = null;   // where the mouse began a box
  let moved = false;

  const at = (event) => {
    const frame = element.getBoundingClientRect();
    return {x: event.clientX - frame.left, y: event.clientY - frame.top};
  };
  const call = (name, ...values) => { if (on[name]) on[name](...values); };
  // A finger scrolls the page until there is something to pan; two fingers are ours.
  const settle = () => { element.style.touchAction = on.zoomed() ? "none" : "pan-x pan-y"; };

  element.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== element) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 20 : 1;
    const p = at(event);
    // With Ctrl come the small steps of a trackpad's pinch, too.
    const factor = Math.pow(2, -event.deltaY * lines / (event.ctrlKey ? 100 : 300));
    on.zoom(Math.min(Math.max(factor, 1 / 1.5), 1.5), p.x, p.y);
    settle();
  }, {passive: false});

  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pointers.set(event.pointerId, at(event));
    moved = false;
    box = on.box && event.pointerType === "mouse" && !event.shiftKey ? at(event) : null;
  });

  element.addEventListener("pointermove", (event) => {
    const p = at(event), last = pointers.get(event.pointerId);
    if (!last) {
      call("hover", p.x, p.y);
      return;
    }
    if (!moved && Math.hypot(p.x - last.x, p.y - last.y) < 4) return;
    if (!moved) element.setPointerCapture(event.pointerId);
    moved = true;
    if (pointers.size === 2) {
      let other;
      for (const [id, q] of pointers) if (id !== event.pointerId) other = q;
      const before = Math.hypot(last.x - other.x, last.y - other.y), after = Math.hypot(p.x - other.x, p.y - other.y);
      if (before > 0 && after > 0) on.zoom(after / before, other.x, other.y);
      settle();
    } else if (box) {
      on.box(box, p, false);
      return;  // the last position stays where the box began
    } else if (on.zoomed()) {
      on.pan(p.x - last.x, p.y - last.y);
    }
    pointers.set(event.pointerId, p);
  });

  const end = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const p = at(event);
    if (box && moved && event.type === "pointerup") on.box(box, p, true);
    else if (!moved) call("hover", p.x, p.y);
    box = null;
    settle();
  };
  element.addEventListener("pointerup", end);
  element.addEventListener("pointercancel", end);
  element.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") call("leave"); });
  element.addEventListener("blur", () => call("leave"));
  element.addEventListener("dblclick", (event) => {
    event.preventDefault();
    on.reset();
    settle();
  });

  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const x = element.clientWidth / 2, y = element.clientHeight / 2;
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.key === "+" || event.key === "=") on.zoom(1.5, x, y);
    else if (event.key === "-") on.zoom(1 / 1.5, x, y);
    else if (event.key === "0" || event.key === "Escape") on.reset();
    else if (arrows[event.key]) {
      const [dx, dy] = arrows[event.key];
      if (on.step) on.step(dx + dy);
      else if (on.zoomed()) on.pan(-40 * dx, -40 * dy);
      else return;
    } else return;
    event.preventDefault();
    settle();
  });
  settle();
};

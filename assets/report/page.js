// SPDX-License-Identifier: MIT
// What the scripts of the page share, the button of the theme, and the contents.
"use strict";
const izb = {};

/// An element with classes and text.
izb.element = function (tag, className, text) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text !== undefined) element.textContent = text;
  return element;
};

/// A number for reading, as in the tables: commas between thousands, a true minus sign. Without `digits` three
/// significant ones or more.
izb.number = function (value, digits) {
  if (value === null || value === undefined) return "–";
  const size = Math.abs(value);
  if (digits === null || digits === undefined) {
    if (size > 0 && size < 1e-4) return value.toExponential(2).replace(/-/g, "−");
    digits = size === 0 || size >= 100 ? 0 : 2 - Math.floor(Math.log10(size));
  }
  return value.toLocaleString("en-US", {minimumFractionDigits: digits, maximumFractionDigits: digits}).replace("-", "−");
};

(function () {
  const root = document.documentElement;

  function setUpTheme() {
    const button = document.querySelector("button.theme");
    const system = matchMedia("(prefers-color-scheme: dark)");
    const isDark = () => (root.dataset.theme ? root.dataset.theme === "dark" : system.matches);
    const label = () => { button.textContent = isDark() ? "Light" : "Dark"; };
    button.hidden = false;
    button.addEventListener("click", () => {
      root.dataset.theme = isDark() ? "light" : "dark";
      try {
        localStorage.setItem("izb-report-theme", root.dataset.theme);
      } catch (error) {
        // It holds for this visit.
      }
      label();
    });
    system.addEventListener("change", label);
    label();
  }

  /// Marks the section that is being read.
  function setUpContents() {
    const links = new Map();
    for (const link of document.querySelectorAll("nav a")) links.set(link.hash.slice(1), link);
    const visible = new Set();
    const observer = new IntersectionObserver((entries) => {
      for (const entry of entries) entry.isIntersecting ? visible.add(entry.target.id) : visible.delete(entry.target.id);
      let first = true;
      for (const [id, link] of links) {
        const current = first && visible.has(id);
        if (current) link.setAttribute("aria-current", "true");
        else link.removeAttribute("aria-current");
        if (current) first = false;
      }
    }, {rootMargin: "-10% 0px -50% 0px"});
    for (const section of document.querySelectorAll("main > section")) observer.observe(section);
  }

  setUpTheme();
  setUpContents();
})();

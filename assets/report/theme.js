// SPDX-License-Identifier: MIT
// Runs before the page is shown: the theme that the reader chose last time, if this browser keeps anything.
document.documentElement.classList.add("js");
try {
  const kept = localStorage.getItem("izb-report-theme");
  if (kept === "light" || kept === "dark") document.documentElement.dataset.theme = kept;
} catch (error) {
  // Files may have no storage: then the system's theme it is.
}

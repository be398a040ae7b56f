// SPDX-License-Identifier: MIT
// Runs within the example's report in a browser: does what a reader does, and leaves what it found in the page.
// report_browser_test.cpp reads it.
"use strict";
(async function () {
  const findings = [];
  const check = (what, ok, seen) => findings.push({what, ok: Boolean(ok), seen: seen === undefined ? "" : String(seen)});
  const same = (what, seen, expected) => check(what, JSON.stringify(seen) === JSON.stringify(expected),
    `${JSON.stringify(seen)} instead of ${JSON.stringify(expected)}`);
  const frames = async (count) => { for (let i = 0; i < count; ++i) await new Promise(requestAnimationFrame); };
  const all = (selector, from = document) => Array.from(from.querySelectorAll(selector));
  const one = (selector, from = document) => from.querySelector(selector);
  Element.prototype.setPointerCapture = () => {};  // of a pointer that is not there

  /// An event at a share of the element's width and height.
  function send(element, kind, x, y, more = {}) {
    const frame = element.getBoundingClientRect();
    const Kind = kind === "wheel" ? WheelEvent : kind.startsWith("pointer") ? PointerEvent : MouseEvent;
    const event = new Kind(kind, {bubbles: true, cancelable: true, button: 0, pointerType: "mouse", pointerId: 1,
      clientX: frame.left + x * frame.width, clientY: frame.top + y * frame.height, ...more});
    element.dispatchEvent(event);
    return event;
  }
  const press = (element, key) => element.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
  const plot = (id) => one(`#${id}-plot`), drawing = (id) => one(`#${id}-plot .stage > svg`);
  const ticks = (id) => all(".axis .tick text", drawing(id)).map((text) => text.textContent);

  function drawn() {
    same("plots", all("figure.plot .stage > svg").length, 7);
    for (const svg of all("figure.plot .stage > svg")) {
      const name = svg.getAttribute("aria-label");
      check(`${name}: numbers only`, !/NaN|undefined|Infinity/.test(svg.outerHTML), svg.outerHTML.match(/.{60}(NaN|undefined|Infinity)/));
      check(`${name}: has size`, svg.getBoundingClientRect().height > 150, svg.getBoundingClientRect().height);
    }
    const lines = all(".line", drawing("grid-time"));
    same("lines", lines.map((path) => path.getAttribute("d").split("L").length), [6, 6, 4 - 1]);  // the paper's: a point, then three
    same("only the paper's is dashed", lines.map((path) => getComputedStyle(path).strokeDasharray), ["none", "none", "6px, 4px"]);
    same("a band", all(".band", drawing("grid-time")).length, 1);
    same("the measured grids are the ticks", ticks("grid-leaks").filter((text) => text.includes(",")).slice(-4), ["1,024", "2,048", "4,096", "8,192"]);
    same("gaps", all(".line", drawing("frames")).map((path) => path.getAttribute("d").split("M").length - 1), [2, 3]);
    same("a value between gaps is marked", all(".symbol", drawing("frames")).length, 1);
    same("stacked bars", all(".bar", drawing("stages")).length, 6 * 6 * 2 - 2);
    same("bars begin at zero", ticks("stages")[0], "0");
    same("the paper's are hatched", all(".bar", drawing("stages")).filter((bar) => bar.style.fill.includes("-hatch-")).length, 6 * 6);
    same("a sum without a part says so", all(".value", drawing("stages")).filter((text) => text.textContent.endsWith("without visibility")).length, 2);
    same("seventeen categories", all(".category", drawing("ablation")).length, 17);
    same("bars", all(".bar", drawing("ablation")).length, 17 * 2 - 1);
    same("whiskers", all(".whisker", drawing("ablation")).length, 17);
    check("negative bars lie left of zero", all(".bar", drawing("ablation")).some((bar) =>
      Number(bar.getAttribute("x")) + Number(bar.getAttribute("width")) <= Number(one(".zero", drawing("ablation")).getAttribute("x1")) + 0.01));
    for (const id of ["stages", "ablation", "grid-time"]) {
      const boxes = all(".axis .tick text", drawing(id)).map((text) => text.getBoundingClientRect());
      const overlap = boxes.some((a, i) => boxes.some((b, k) => k > i && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom));
      check(`${id}: no label on another`, !overlap);
    }
    same("marks of software GL on plots", all("figure.plot .software").length, 7);
  }

  function sorting() {
    const table = one("#scenes-table"), head = all("thead th", table)[2], button = one("button", head);
    const column = () => all("tbody tr", table).map((row) => Number(row.cells[2].dataset.value ?? NaN));
    const before = column(), numbers = before.filter((value) => !Number.isNaN(value)).sort((a, b) => a - b);
    check("there is a cell without a value", numbers.length === before.length - 1, numbers.length);
    button.click();
    same("rises", column(), [...numbers, NaN]);
    same("says so", head.getAttribute("aria-sort"), "ascending");
    button.click();
    same("falls, what has no value stays last", column(), [...numbers.reverse(), NaN]);
    button.click();
    same("is as it was", column(), before);
    const names = all("thead button", table)[0];
    names.click();
    same("names as numbers count", all("tbody th", table).slice(1, 4).map((cell) => cell.textContent.split("_with")[0]), ["scene_0", "scene_1", "scene_2"]);
    // Below a group: the second of "visibility" is the paper's.
    const grouped = one("#table1-table"), paper = all("thead tr:nth-child(2) th", grouped)[9];
    one("button", paper).click();
    same("a column of a group", all("tbody tr", grouped).map((row) => row.cells[11].textContent), ["2.9", "7.3", "7.5", "19.5", "51.7", "67.4"]);
    same("the summary stays below", one("tfoot th", grouped).textContent, "median");
  }

  async function legend() {
    const button = all(".legend button", plot("grid-time"))[0], before = ticks("grid-time");
    button.click();
    await frames(3);
    same("hidden", all(".series", drawing("grid-time")).length, 2);
    same("says so", button.getAttribute("aria-pressed"), "false");
    check("the axis follows what is shown", JSON.stringify(ticks("grid-time")) !== JSON.stringify(before), ticks("grid-time"));
    button.click();
    await frames(3);
    same("shown again", ticks("grid-time"), before);
  }

  async function zooming() {
    for (const id of ["grid-time", "frames", "stages"]) {
      const svg = drawing(id), before = ticks(id), reset = one(".tools button", plot(id));
      const scrolled = send(svg, "wheel", 0.5, 0.5, {deltaY: -300});
      check(`${id}: the wheel scrolls the page`, !scrolled.defaultPrevented);
      const taken = send(svg, "wheel", 0.5, 0.5, {deltaY: -300, ctrlKey: true});
      await frames(3);
      check(`${id}: with Ctrl it zooms`, taken.defaultPrevented && JSON.stringify(ticks(id)) !== JSON.stringify(before), ticks(id));
      check(`${id}: may be reset`, !reset.disabled);
      send(svg, "dblclick", 0.5, 0.5);
      await frames(3);
      same(`${id}: all again`, ticks(id), before);
      send(svg, "pointerdown", 0.5, 0.3);
      send(svg, "pointermove", 0.6, 0.4);
      send(svg, "pointermove", 0.7, 0.6);
      check(`${id}: a box`, one(".selection", svg));
      send(svg, "pointerup", 0.7, 0.6);
      await frames(3);
      check(`${id}: zoomed to it`, JSON.stringify(ticks(id)) !== JSON.stringify(before) && !reset.disabled, ticks(id));
      reset.click();
      await frames(3);
      same(`${id}: reset`, ticks(id), before);
    }
    const svg = drawing("frames"), before = ticks("frames");
    for (const [pointerId, x] of [[1, 0.45], [2, 0.55]]) send(svg, "pointerdown", x, 0.5, {pointerId, pointerType: "touch"});
    for (const [pointerId, x] of [[1, 0.3], [2, 0.7]]) send(svg, "pointermove", x, 0.5, {pointerId, pointerType: "touch"});
    for (const pointerId of [1, 2]) send(svg, "pointerup", 0.5, 0.5, {pointerId, pointerType: "touch"});
    await frames(3);
    check("two fingers zoom", JSON.stringify(ticks("frames")) !== JSON.stringify(before), ticks("frames"));
    press(svg, "0");
    await frames(3);
    same("a key resets", ticks("frames"), before);
  }

  function tips() {
    const svg = drawing("grid-time"), tip = one(".tip", plot("grid-time"));
    check("no tip", tip.hidden);
    const symbol = all(".symbol", svg)[2].getBoundingClientRect(), frame = svg.getBoundingClientRect();
    send(svg, "pointermove", (symbol.left + symbol.width / 2 - frame.left) / frame.width, 0.5);
    same("values under the pointer", all("td", tip).map((cell) => cell.textContent).filter((text) => text).slice(0, 3), ["32 samples", "290 ms", "270 – 319"]);
    same("where", one("strong", tip).textContent, "light grid 1,024 texels");
    check("within the page", tip.getBoundingClientRect().left >= 0 && tip.getBoundingClientRect().right <= innerWidth);
    send(svg, "pointerleave", 2, 2);
    check("gone", tip.hidden && !one(".cursor", svg));
    press(svg, "ArrowRight");
    press(svg, "ArrowRight");
    same("by keys", one("strong", tip).textContent, "light grid 512 texels");
  }

  async function saving() {
    let blob;
    const create = URL.createObjectURL;
    URL.createObjectURL = (given) => { blob = given; return create.call(URL, given); };
    HTMLAnchorElement.prototype.click = () => {};  // a browser without a window waits for the download for ever
    for (const id of ["stages", "grid-time"]) {
      all(".tools button", plot(id))[1].click();
      const text = await blob.text(), parsed = new DOMParser().parseFromString(text, "image/svg+xml");
      check(`${id}: an SVG`, parsed.documentElement.localName === "svg" && !parsed.querySelector("parsererror"), text.slice(0, 200));
      check(`${id}: stands alone`, !text.includes("var(") && !text.includes("NaN"), text.match(/.{40}var\(.{20}/));
      check(`${id}: with its title`, text.includes(one(".title", plot(id)).textContent) && text.includes("software GL"));
    }
    const csv = atob(one('a[download="scenes.csv"]').href.split("base64,")[1]);
    same("lines of the CSV", csv.trim().split("\r\n").length, 41);
  }

  function images() {
    const shown = () => all("figure.images img").map((image) => image.style.transform);
    all("figure.images .tools button")[0].click();
    send(all(".pane")[1], "wheel", 0.9, 0.9, {deltaY: -300, ctrlKey: true});
    check("zoomed", shown()[0].includes("scale(3)"), shown()[0]);
    same("together", shown(), [shown()[0], shown()[0], shown()[0]]);
    send(all(".pane")[0], "pointermove", 0.25, 0.5);
    same("the pointer is marked in the others", all(".cross").map((cross) => cross.hidden), [true, false, false]);
    const before = shown()[0];
    send(all(".pane")[0], "pointerdown", 0.5, 0.5);
    send(all(".pane")[0], "pointermove", 0.6, 0.6);
    send(all(".pane")[0], "pointerup", 0.6, 0.6);
    check("moved", shown()[0] !== before, before);
    send(all(".pane")[0], "dblclick", 0.5, 0.5);
    check("whole", shown()[0].includes("scale(1)"), shown()[0]);
    check("pixels stay squares", getComputedStyle(one("figure.images img")).imageRendering === "pixelated");
  }

  function theme() {
    const ground = () => getComputedStyle(document.body).backgroundColor, before = ground(), button = one("button.theme");
    const other = button.textContent.toLowerCase();
    button.click();
    check("another ground", ground() !== before, ground());
    same("kept", localStorage.getItem("izb-report-theme"), other);
    button.click();
    same("and back", ground(), before);
  }

  function strangers() {
    same("a stranger's name is text", all("#scenes-table tbody th").filter((cell) => cell.textContent.startsWith("<" + "/script>")).map((cell) => cell.textContent),
      ["<" + "/script><b onclick='x'>\"é\" & `ü`.glb"]);
    same("and no element", all("[onclick], main b").length, 0);
    same("nothing was asked for", performance.getEntriesByType("resource").filter((entry) => !entry.name.startsWith("data:")).length, 0);
  }

  await frames(3);
  for (const part of [drawn, sorting, legend, zooming, tips, saving, images, theme, strangers]) {
    await part();
    findings.push({what: part.name, ok: true, seen: "to its end"});
  }
  const result = document.createElement("script");
  result.type = "application/json";
  result.id = "findings";
  result.textContent = JSON.stringify(findings).replace(/</g, "\\u003c");
  document.body.append(result);
})();

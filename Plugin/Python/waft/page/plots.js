"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Small plots of the run: lines over frames, iterations or rounds.

const SVG = "http://www.w3.org/2000/svg";
const PLOT = { width: 320, height: 116, left: 38, right: 6, top: 6, bottom: 18 };

function drawn(name, attributes, parent) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

function element(name, content, properties = {}) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...[content].flat());
  return made;
}

function figure(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  return size === 0 ? "0" : size >= 1000 || size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(3)));
}

class Plot {
  // series: {name, values, kind: "", "second", "faint" or "band" (then also lows)}; values are at 0, 1, ... in the unit of `of`.
  constructor({ title, unit, of, series, isLog = false, highest = 0, summary, onPick }) {
    Object.assign(this, { series, isLog, count: Math.max(...series.map(({ values }) => values.length)) });
    this.root = element("figure", element("figcaption", [title, element("span", unit)]));
    this.svg = drawn("svg", { viewBox: `0 0 ${PLOT.width} ${PLOT.height}`, role: "img", "aria-label": summary }, null);
    this.root.append(this.svg);
    const all = series.flatMap(({ values, lows = [] }) => [...values, ...lows]).filter((value) => Number.isFinite(value) && (!isLog || value > 0));
    this.high = Math.max(...all, highest, 1e-12);
    this.low = isLog ? Math.max(Math.min(...all, 0.99 * this.high), 1e-4 * this.high) : 0;  // four decades show enough
    for (const value of isLog ? [this.low, this.high] : [0, this.high / 2, this.high]) {
      const y = this.y(value);
      drawn("line", { x1: PLOT.left, x2: PLOT.width - PLOT.right, y1: y, y2: y, class: "plot-axis" }, this.svg);
      drawn("text", { x: PLOT.left - 5, y: y + 3.5, "text-anchor": "end", class: "plot-text" }, this.svg).textContent = figure(value);
    }
    const label = (x, anchor, text) => {
      drawn("text", { x, y: PLOT.height - 4, "text-anchor": anchor, class: "plot-text" }, this.svg).textContent = text;
    };
    label(PLOT.left, "start", "0");
    label(PLOT.width - PLOT.right, "end", `${this.count - 1} ${of}`);
    this.shapes = series.map((entry) => drawn("path", { class: entry.kind === "band" ? "plot-band" : `plot-line ${entry.kind || ""}` }, this.svg));
    series.forEach((entry, index) => this.trace(index, entry.values, entry.lows));
    this.cursor = drawn("line", { y1: PLOT.top, y2: PLOT.height - PLOT.bottom, class: "plot-cursor", visibility: "hidden" }, this.svg);
    this.root.append(element("div", series.map(({ name, kind }) => element("span", [element("i", "", { className: kind || "" }), name])), { className: "plot-key" }));
    if (onPick) {
      this.svg.style.cursor = "pointer";
      const pick = (event) => {
        const { left, width } = this.svg.getBoundingClientRect();
        const x = (event.clientX - left) / width * PLOT.width;
        onPick(Math.round((x - PLOT.left) / (PLOT.width - PLOT.left - PLOT.right) * (this.count - 1)));
      };
      this.svg.addEventListener("pointerdown", pick);
      this.svg.addEventListener("pointermove", (event) => event.buttons && pick(event));
    }
  }

  x(index) {
    return PLOT.left + (PLOT.width - PLOT.left - PLOT.right) * (this.count > 1 ? index / (this.count - 1) : 0.5);
  }

  y(value) {
    const part = this.isLog ? Math.log(value / this.low) / Math.log(this.high / this.low) : (value - this.low) / (this.high - this.low);
    return PLOT.height - PLOT.bottom - (PLOT.height - PLOT.top - PLOT.bottom) * part;
  }

  trace(index, values, lows) {
    const point = (value, k) => `${this.x(k).toFixed(1)} ${this.y(Math.max(value, this.isLog ? this.low : value)).toFixed(1)}`;
    let way = Array.from(values, point).join("L");
    if (lows) way += "L" + Array.from(lows, point).reverse().join("L") + "Z";
    this.shapes[index].setAttribute("d", way ? "M" + way : "");
  }

  mark(index) {
    for (const name of ["x1", "x2"]) this.cursor.setAttribute(name, this.x(index).toFixed(1));
    this.cursor.setAttribute("visibility", "visible");
  }
}

// Speed of an object at every frame [m/s]: central differences, one-sided at the ends.
function speedsOf(positions, frames, rate) {
  return Float32Array.from({ length: frames }, (_, k) => {
    const a = Math.max(k - 1, 0), b = Math.min(k + 1, frames - 1);
    const way = Math.hypot(...[0, 1, 2].map((axis) => positions[3 * b + axis] - positions[3 * a + axis]));
    return way * rate / Math.max(b - a, 1);
  });
}

function speedPlot(run, objects, onPick) {
  const all = objects.map(({ positions }) => speedsOf(positions, run.frames, run.rate));
  const quantiles = [0.1, 0.5, 0.9].map((part) => Float32Array.from({ length: run.frames }, (_, k) => {
    const sorted = all.map((speeds) => speeds[k]).sort((a, b) => a - b);
    const at = part * (sorted.length - 1), first = Math.floor(at);
    return mix(sorted[first], sorted[Math.min(first + 1, sorted.length - 1)], at - first);
  }));
  const fastest = Math.max(...all.map((speeds) => Math.max(...speeds)));
  const many = objects.length > 3;
  const series = many ? [
    { name: "10 to 90 %", kind: "band", values: quantiles[2], lows: quantiles[0] },
    { name: "median", values: quantiles[1] },
    { name: "followed", kind: "second", values: [] },
  ] : all.map((values, index) => ({ name: objects[index].name, kind: ["", "second", "faint"][index], values }));
  const plot = new Plot({ title: "Speed", unit: "m/s", of: "frames", series, onPick, highest: fastest,
    summary: `Speeds over ${run.frames} frames; the fastest is ${figure(fastest)} metres a second` });
  plot.follow = (index) => many && plot.trace(2, index < 0 ? [] : all[index]);
  return plot;
}

function energyPlot({ columns, rows }) {
  const column = (name) => rows.map((row) => row[columns.indexOf(name)]);
  const total = column("E");
  return new Plot({ title: "Energy", unit: "E and its parts", of: "iterations", isLog: true,
    series: [{ name: "E", values: total }, ...["Ex", "Ev", "Ec"].filter((name) => columns.includes(name))
      .map((name, index) => ({ name, kind: ["faint", "second", "faint"][index], values: column(name) }))],
    summary: `E is ${figure(total[0])} at first and ${figure(total[total.length - 1])} in the end, after ${rows.length - 1} iterations` });
}

function roundsPlot(rounds) {
  const after = rounds.filter(({ stage }) => stage !== "draw");
  const sampledAirs = rounds.filter(({ stage }) => stage === "draw");
  const best = sampledAirs.length ? [Math.min(...sampledAirs.map(({ control }) => control))] : [];
  const controls = [...best, ...after.map(({ control }) => control)];
  if (controls.length < 2) return null;
  const first = best.length ? [`best of ${sampledAirs.length} sampled airs`] : [];
  const names = [...first, ...after.map(({ stage }) => stage)];
  const plot = new Plot({ title: "Control", unit: "what the air does not do, m/s", of: "rounds",
    series: [{ name: `${names[0]} → ${names[names.length - 1]}`, values: controls }],
    summary: `Control of ${figure(controls[0])} metres a second at first and ${figure(controls[controls.length - 1])} in the end, over ${names.join(", ")}` });
  controls.forEach((value, index) => {
    const dot = drawn("circle", { cx: plot.x(index), cy: plot.y(value), r: 2.6, class: "plot-dot" }, plot.svg);
    drawn("title", {}, dot).textContent = `${names[index]}: ${figure(value)} m/s`;
  });
  return plot;
}

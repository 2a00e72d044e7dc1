"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Words and tables: what is shown, what was measured, what came of each mark.

const byName = (id) => document.getElementById(id);

function plural(count, name) {
  return `${count} ${name}${count === 1 ? "" : "s"}`;
}

// "16 × gold, 16 × maple": what flies, by the names of the shapes.
function fliers(objects, shapes) {
  const counts = shapes.map(({ name }, index) => [objects.filter(({ shape }) => shape === index).length, name]);
  return counts.filter(([count]) => count).map(([count, name]) => `${count} × ${name}`).join(", ");
}

function tellFacts(run, objects, shapes) {
  const seconds = run.frames / run.rate;
  const met = run.marks.filter(({ status }) => status === "met").length;
  byName("title").textContent = run.title;
  byName("subtitle").textContent = `${plural(objects.length, "object")} in one air · ${figure(seconds)} s · ${met} of ${plural(run.marks.length, "mark")} met`;
  byName("canvas").setAttribute("aria-label", `${run.title}: ${fliers(objects, shapes)}, in flight. Arrow keys step through frames, space plays.`);
  byName("version").textContent = run.version;
  byName("three").textContent = THREE.REVISION;
  const facts = [
    ["flying", fliers(objects, shapes)],
    ["marks met", `${met} of ${run.marks.length}`, met === run.marks.length ? "met" : "missed"],
    ["quality", run.quality + (run.stoppedEarly ? ", stopped early" : "")],
    ["seed", run.seed], ["scene", run.scene],
    ["length", `${run.frames} frames, ${figure(run.rate)} a second` + (run.every > 1 ? `: one of each ${run.every} that were flown` : "")],
    ["Waft", run.version],
  ];
  byName("facts").append(...facts.flatMap(([name, value, kind = ""]) => [element("dt", name), element("dd", String(value), { className: kind })]));
}

function reportMeasured({ folder, tracks, rows, notes }) {
  byName("measured").hidden = false;
  byName("measured-note").textContent = [`How the motion (${tracks}) compares with bodies that drift in free air.`, ...notes].join(" ");
  const wanted = ([low, high]) => low === null ? high === null ? "" : `≤ ${figure(high)}` : high === null ? `≥ ${figure(low)}` : `${figure(low)} to ${figure(high)}`;
  const besides = (row) => row.value === null ? [`not measured: ${row.why}`]
    : [wanted(row.wanted) && `wanted ${wanted(row.wanted)}`, row.drifters !== null && `drifters ${figure(row.drifters)}`].filter(Boolean);
  byName("measured").querySelector("tbody").append(...rows.map((row) => element("tr", [
    element("td", [row.row, element("small", besides(row).join(", "))]),
    element("td", figure(row.value), { className: row.met === false ? "missed" : row.met ? "met" : "" }),
  ])));
}

const CONSTRAINTS = { rest: "lie", position: "pass", velocity: "velocity", acceleration: "acceleration", orientation: "turn" };
const UNITS = { rest: "m", position: "m", velocity: "m/s", acceleration: "m/s²", orientation: "rad" };

function constraintText(mark, every) {
  return mark.kind === "position" && mark.places.length > 1 ? `path, to ${mark.places[mark.places.length - 1][0] * every}` : CONSTRAINTS[mark.kind] || mark.kind;
}

function reportMarks(run, names, choose) {
  if (!run.marks.length) return;
  byName("constraints").hidden = false;
  const order = { met: 1 };  // what was missed comes first
  const marks = [...run.marks].sort((a, b) => (order[a.status] || 0) - (order[b.status] || 0));
  byName("constraints").querySelector("tbody").append(...marks.map((mark) => {
    const go = element("button", names.get(mark.object) || "none", { type: "button", title: "Go there and follow it" });
    go.addEventListener("click", () => choose(mark));
    const status = element("td", mark.status, { className: `status ${mark.status}` });
    const row = element("tr", [status, element("td", go), element("td", String(mark.frame)),
      element("td", constraintText(mark, run.every)), element("td", `${figure(mark.residual)} ${UNITS[mark.kind] || ""}`)]);
    if (mark.message) row.title = mark.message;
    return row;
  }));
}

// Where marks are on the line of time: a line each, missed ones taller.
function drawTicks(svg, run) {
  const last = Math.max(run.frames - 1, 1);
  svg.setAttribute("viewBox", `0 0 ${last} 8`);
  const seen = new Set();
  for (const { shown: frame, status } of run.marks) {
    if (seen.has(`${frame} ${status}`)) continue;
    seen.add(`${frame} ${status}`);
    drawn("line", { x1: frame, x2: frame, y1: status === "met" ? 3 : 0, y2: 8, stroke: `var(--${status})`, "stroke-width": 2,
      "vector-effect": "non-scaling-stroke" }, svg);
  }
}

"use strict";
// Looks closely at figures: linked zoom, values under the pointer, stretches of the log behind a
// cell. Every number shown stands in the JSON of the page.
(() => {
const page = document.getElementById("close");
const data = JSON.parse(document.getElementById("values").textContent);
const { plane, time, paths, runs } = data;
if (!plane.cells.length && !time) return;
const id = name => document.getElementById(name);
const SVG = "http://www.w3.org/2000/svg";

/** A new element with attributes and children. */
function make(name, attributes = {}, ...children) {
  const of = name.startsWith("svg:") ? document.createElementNS(SVG, name.slice(4)) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) of.setAttribute(key, value);
  of.append(...children);
  return of;
}
/** A number of steps as text, with as many digits as the step has. */
function text(steps, step) {
  if (steps == null) return "–";
  const digits = Math.max(0, Math.round(-Math.log10(step)));
  const zero = Math.abs(steps * step) < step / 2;
  return (zero ? 0 : steps * step).toFixed(digits).replace("-", "−");
}
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const COLOURS = { "before": "--before", "after": "--after", "as filed": "--before", "corrected": "--after",
  "observed": "--ink", "left track": "--left", "right track": "--right" };
const DASHES = { "before": [], "after": [], "left track": [], "right track": [6, 3] };
/** Round numbers inside a range. */
function ticks([low, high], count) {
  const least = (high - low) / count, power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map(k => k * power).find(step => step >= least * 0.999);
  const all = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) all.push(k * step);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return all.map(value => [value, (Math.abs(value) < step / 2 ? 0 : value).toFixed(digits).replace("-", "−")]);
}

const T = time ? time.t.map(steps => steps * time.step) : [];
const state = { view: time ? [0, time.end] : null, at: null, cell: null, stretch: 0, panel: 0 };
const charts = [];

/** The run at a place on the axis of time. */
const runAt = at => runs.find((run, k) => at < run.at + run.long || k === runs.length - 1);
/** A place on the axis of time as a time in the log. */
const stamp = (run, at) => `log time ${text(Math.round((at - run.at + run.start) / time.step), time.step)} s`;
const named = run => `${run.name}${run.held ? " (held out)" : ""}`;
function moment(at) {
  const run = runAt(at);
  return `${named(run)}, ${stamp(run, at)}`;
}
function announce(what) { id("heard").textContent = what; }

// Charts over time.

function shade(chart) {
  const { ctx, bbox } = chart;
  const x = at => clamp(chart.valToPos(at, "x", true), bbox.left, bbox.left + bbox.width);
  ctx.save();
  ctx.fillStyle = style("--held");
  for (const run of runs.filter(run => run.held)) {
    ctx.fillRect(x(run.at), bbox.top, x(run.at + run.long) - x(run.at), bbox.height);
  }
  const stretches = chosen();
  ctx.fillStyle = style("--mark");
  const { min, max } = chart.scales.x;
  stretches.forEach(([begin, end], k) => {
    if (end < min || begin > max) return;
    ctx.globalAlpha = k === state.stretch ? 0.5 : 0.22;
    ctx.fillRect(x(begin), bbox.top, Math.max(2, x(end) - x(begin)), bbox.height);
  });
  ctx.globalAlpha = 1;
  ctx.fillStyle = style("--second");
  for (const run of runs.slice(1)) {
    if (run.at > min && run.at < max) ctx.fillRect(x(run.at), bbox.top, 1, bbox.height);
  }
  ctx.restore();
}

function chart(lines, last) {
  const keys = make("div", { class: "keys", "aria-hidden": "true" });
  const outputs = lines.lines.map(line => {
    const output = make("output");
    keys.append(make("span", { class: "key", style: `--colour:var(${COLOURS[line.name]})` }, `${line.name} `, output));
    return output;
  });
  const plot = make("div", { class: "plot", "aria-hidden": "true" });
  id("times").append(make("div", { class: "chart" }, make("h3", {}, `${lines.title} (${lines.unit})`), keys, plot));
  const axis = { stroke: () => style("--second"), grid: { stroke: () => style("--line"), width: 1 },
    ticks: { stroke: () => style("--line"), width: 1, size: 4 }, font: "12px system-ui, sans-serif" };
  const numbers = (_, values) => values.map(value => String(value).replace("-", "−"));
  const height = last ? 158 : 118;
  const options = {
    width: plot.clientWidth, height, legend: { show: false },
    padding: [6, 8, last ? 0 : 4, 0],
    cursor: { drag: { x: true, y: false, dist: 5, setScale: false }, y: false, points: { size: 7 },
      bind: { dblclick: () => () => { show([0, time.end]); return null; } } },
    scales: { x: { time: false, range: () => state.view }, y: { range: () => lines.range } },
    axes: [{ ...axis, size: last ? 46 : 4, label: last ? time.label : null, labelSize: 18, labelFont: "12px system-ui, sans-serif",
      values: last ? numbers : () => [] }, { ...axis, size: 44, values: numbers, space: 26 }],
    series: [{}, ...lines.lines.map(line => ({ stroke: () => style(COLOURS[line.name]), width: 1.5,
      dash: DASHES[line.name], points: { show: false } }))],
    hooks: {
      drawClear: [shade],
      setSelect: [of => {
        if (of.select.width < 5) return;
        show([of.posToVal(of.select.left, "x"), of.posToVal(of.select.left + of.select.width, "x")]);
        of.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      }],
      // scales are known only now
      draw: [mark],
    },
  };
  const of = new uPlot(options, [T, ...lines.lines.map(line => line.v.map(v => v == null ? null : v * lines.step))], plot);
  const under = event => {
    const box = of.over.getBoundingClientRect();
    point(of.posToIdx(clamp(event.clientX - box.left, 0, box.width)));
  };
  of.over.addEventListener("pointerdown", under);
  of.over.addEventListener("pointermove", under);
  of.over.addEventListener("pointerleave", () => setTimeout(() => mark(of)));
  charts.push({ of, outputs, lines, plot, height });
}

/** Shows a stretch of time in all charts and on the path. */
function show([low, high]) {
  const least = Math.min(0.5, time.end);
  const middle = (low + high) / 2, half = Math.max(high - low, least) / 2;
  state.view = [Math.max(0, middle - half), Math.min(time.end, middle + half)];
  for (const { of } of charts) of.setScale("x", { min: state.view[0], max: state.view[1] });
  const first = T.findIndex(t => t >= state.view[0]), last = T.findLastIndex(t => t <= state.view[1]);
  Object.assign(id("cursor"), { min: Math.max(first, 0), max: Math.max(last, first, 0) });
  id("all").disabled = state.view[0] <= 0 && state.view[1] >= time.end;
  if (state.at == null || T[state.at] < state.view[0] || T[state.at] > state.view[1]) {
    point(T.findIndex(t => t >= middle), true);
  } else point(state.at, true);
}

/** Points at a time: values in the charts, place on the path. */
function point(index, isMoved) {
  if (index < 0 || (index === state.at && !isMoved)) return;
  // a gap has no values
  const has = k => charts.some(({ lines }) => lines.lines.some(line => line.v[k] != null));
  if (!has(index) && has(index + 1)) index += 1;
  state.at = index;
  for (const { outputs, lines } of charts) {
    lines.lines.forEach((line, k) => { outputs[k].textContent = text(line.v[index], lines.step); });
  }
  for (const { of } of charts) mark(of);
  const values = charts.map(({ lines }) =>
    `${lines.title.toLowerCase()} ${lines.lines.map(line => `${text(line.v[index], lines.step)} ${line.name}`).join(", ")} ${lines.unit}`);
  const cursor = id("cursor");
  cursor.value = index;
  cursor.setAttribute("aria-valuetext", `${moment(T[index])}: ${values.join("; ")}`);
  id("moment").textContent = moment(T[index]);
  drawPath();
}

/** Draws the cursor of a chart where the time is. */
function mark(of) {
  if (state.at != null) of.setCursor({ left: of.valToPos(T[state.at], "x"), top: 0 }, false);
}

// The plane of track speeds.

const values = () => plane.panels[state.panel];
function colour(of, steps) {
  const share = clamp((steps * of.step - of.range[0]) / (of.range[1] - of.range[0]), 0, 1) * (of.colours.length - 1);
  const k = Math.min(Math.floor(share), of.colours.length - 2), part = share - k;
  const channel = (hex, at) => parseInt(hex.slice(at, at + 2), 16);
  const mixed = [1, 3, 5].map(at => Math.round(channel(of.colours[k], at) * (1 - part) + channel(of.colours[k + 1], at) * part));
  return `rgb(${mixed.join()})`;
}
const speed = steps => text(steps, plane.step);
function describe(cell) {
  const [left, right] = plane.cells[cell], of = values();
  const shown = /, (before|after)$/.exec(of.title);
  const pair = shown ? ["before", "after"].map(when => [when, plane.panels.find(one => one.title === of.title.replace(shown[0], `, ${when}`))]) : [];
  const said = pair.filter(([, one]) => one).map(([when, one]) => `${text(one.v[cell], one.step)} ${when}`);
  const name = of.title.replace(/, (before|after)$/, "");
  return `Tracks ${speed(left)} m/s left, ${speed(right)} m/s right: ${name} ${said.join(", ")} (${of.label})`;
}
function chosen() {
  if (state.cell == null) return [];
  const flat = plane.stretches[state.cell] || [];
  return Array.from({ length: flat.length / 2 }, (_, k) => [flat[2 * k] * time.step, flat[2 * k + 1] * time.step]);
}

const SIZE = 400, EDGE = { left: 52, bottom: 42, top: 6, right: 8 };
function drawPlane() {
  const svg = id("plane"), width = svg.clientWidth || 400, side = Math.min(width - EDGE.left - EDGE.right, SIZE);
  const height = side + EDGE.top + EDGE.bottom;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.style.height = `${height}px`;
  const place = value => (value / plane.extent + 1) / 2 * side;
  const x = value => EDGE.left + place(value), y = value => EDGE.top + side - place(value);
  const held = svg.contains(document.activeElement);
  svg.replaceChildren();
  for (const [value, label] of ticks([-plane.extent, plane.extent], side / 70)) {
    svg.append(make("svg:line", { class: "grid", x1: x(value), x2: x(value), y1: EDGE.top, y2: EDGE.top + side }),
      make("svg:line", { class: "grid", x1: EDGE.left, x2: EDGE.left + side, y1: y(value), y2: y(value) }),
      make("svg:text", { x: x(value), y: EDGE.top + side + 16, "text-anchor": "middle" }, label),
      make("svg:text", { x: EDGE.left - 6, y: y(value) + 4, "text-anchor": "end" }, label));
  }
  const label = (steps, attributes) => svg.append(make("svg:text", { "text-anchor": "middle", ...attributes }, steps));
  label("left track (m/s)", { x: EDGE.left + side / 2, y: height - 6 });
  label("right track (m/s)", { transform: `translate(12 ${EDGE.top + side / 2}) rotate(-90)` });
  const of = values(), group = make("svg:g", { class: "cells" });
  const half = plane.half == null ? null : plane.half / plane.extent * side / 2;
  plane.cells.forEach(([left, right], cell) => {
    if (of.v[cell] == null) return;
    const at = [x(left * plane.step), y(right * plane.step)];
    const attributes = { class: "cell", fill: colour(of, of.v[cell]), tabindex: -1, role: time ? "button" : "img",
      "aria-label": describe(cell), "data-cell": cell };
    group.append(half == null ? make("svg:circle", { ...attributes, cx: at[0], cy: at[1], r: 5.5 })
      : make("svg:rect", { ...attributes, x: at[0] - half, y: at[1] - half, width: 2 * half, height: 2 * half }));
  });
  svg.append(group, make("svg:rect", { class: "frame", x: EDGE.left, y: EDGE.top, width: side, height: side }));
  svg.append(make("svg:g", { id: "rings" }));
  const cells = [...group.children];
  const current = cells.find(one => one.dataset.cell === String(focused)) || cells[0];
  if (current) { current.setAttribute("tabindex", 0); focused = Number(current.dataset.cell); if (held) current.focus(); }
  rings();
  id("colours").replaceChildren(text(Math.round(of.range[0] / of.step), of.step), make("i", { style:
    `background:linear-gradient(to right,${of.colours.join()})` }), `${text(Math.round(of.range[1] / of.step), of.step)} (${of.label})`);
}
let focused = null, pointed = null;
const cellOf = cell => id("plane").querySelector(`[data-cell="${cell}"]`);
/** Rings around the cell that is chosen and the one that is pointed at. */
function rings() {
  const group = id("rings");
  if (!group) return;
  group.replaceChildren();
  for (const [cell, name] of [[state.cell, "ring chosen"], [pointed, "ring"]]) {
    const of = cell == null ? null : cellOf(cell);
    if (of) { const ring = of.cloneNode(); for (const key of ["tabindex", "role", "aria-label", "data-cell", "fill"]) ring.removeAttribute(key);
      ring.setAttribute("class", name); group.append(ring); }
  }
}
function pointAt(cell) {
  if (cell === pointed) return;
  pointed = cell;
  if (cell != null) id("said").textContent = describe(cell);
  else if (state.cell != null) id("said").textContent = describe(state.cell);
  rings();
}
function choose(cell) {
  if (!time) return;
  state.cell = cell;
  state.stretch = 0;
  rings();
  showStretch();
}
function showStretch() {
  const all = chosen();
  id("previous").disabled = id("next").disabled = all.length < 2;
  id("which").textContent = all.length ? `stretch ${state.stretch + 1} of ${all.length}` : "";
  if (!all.length) return;
  const [begin, end] = all[state.stretch], room = Math.max(3, end - begin);
  state.at = null;
  const run = runAt((begin + end) / 2);
  show([Math.max(run.at, begin - room), Math.min(run.at + run.long, end + room)]);
  point(T.findIndex(t => t >= begin), true);
  for (const { of } of charts) of.redraw(false, false);
  announce(`${describe(state.cell)}. Stretch ${state.stretch + 1} of ${all.length}: ${moment(begin)}`);
}

// Paths.

function pieceAt(at) {
  let found = paths.pieces[0];
  for (const piece of paths.pieces) if (piece.at <= at) found = piece;
  return found;
}
function drawPath() {
  if (!paths.pieces.length) return;
  const svg = id("way"), width = svg.clientWidth || 400, height = Math.min(width, 448);
  const at = state.at == null ? 0 : T[state.at], piece = pieceAt(at);
  const t = piece.t.map(steps => piece.at + steps * time.step);
  const [low, high] = state.view;
  const inside = t.map(one => one >= low && one <= high);
  const isPart = inside.filter(Boolean).length >= 2 && !inside.every(Boolean);
  const points = paths.names.map((_, which) => piece.x[which].map((x, k) => [x * paths.step, piece.y[which][k] * paths.step]));
  // the observed path, and the others as far as they are not far away
  const box = [Infinity, -Infinity, Infinity, -Infinity];
  const take = ([x, y]) => { box[0] = Math.min(box[0], x); box[1] = Math.max(box[1], x); box[2] = Math.min(box[2], y); box[3] = Math.max(box[3], y); };
  points.forEach((line, which) => {
    const room = 0.6 * Math.max(box[1] - box[0], box[3] - box[2], 0.05), limits = [...box];
    line.forEach(([x, y], k) => { if (!isPart || inside[k]) take(which ? [clamp(x, limits[0] - room, limits[1] + room), clamp(y, limits[2] - room, limits[3] + room)] : [x, y]); });
  });
  const edge = { left: 52, right: 8, top: 6, bottom: 42 };
  const inner = [width - edge.left - edge.right, height - edge.top - edge.bottom];
  const scale = Math.min(inner[0] / Math.max(box[1] - box[0], 0.1), inner[1] / Math.max(box[3] - box[2], 0.1)) / 1.12;
  const middle = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2];
  const x = value => edge.left + inner[0] / 2 + (value - middle[0]) * scale;
  const y = value => edge.top + inner[1] / 2 - (value - middle[1]) * scale;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.style.height = `${height}px`;
  svg.replaceChildren();
  const far = Math.max(...piece.origin.map(Math.abs)) >= 1e4 ? [0, 0] : piece.origin;
  for (const k of [0, 1]) {
    const half = inner[k] / 2 / scale, range = [middle[k] - half + far[k], middle[k] + half + far[k]];
    for (const [value, label] of ticks(range, inner[k] / 70)) {
      const [at, put] = [value - far[k], k ? y : x];
      svg.append(k ? make("svg:line", { class: "grid", x1: edge.left, x2: edge.left + inner[0], y1: put(at), y2: put(at) })
        : make("svg:line", { class: "grid", x1: put(at), x2: put(at), y1: edge.top, y2: edge.top + inner[1] }),
        k ? make("svg:text", { x: edge.left - 6, y: put(at) + 4, "text-anchor": "end" }, label)
          : make("svg:text", { x: put(at), y: edge.top + inner[1] + 16, "text-anchor": "middle" }, label));
    }
  }
  const counted = k => far[k] === piece.origin[k] ? "" : ` − ${text(piece.origin[k], 1)}`;
  svg.append(make("svg:text", { x: edge.left + inner[0] / 2, y: height - 6, "text-anchor": "middle" }, `x (m)${counted(0)}`),
    make("svg:text", { transform: `translate(12 ${edge.top + inner[1] / 2}) rotate(-90)`, "text-anchor": "middle" }, `y (m)${counted(1)}`));
  const clip = make("svg:svg", { x: edge.left, y: edge.top, width: inner[0], height: inner[1], viewBox: `${edge.left} ${edge.top} ${inner[0]} ${inner[1]}` });
  const trace = line => line.map(([px, py], k) => `${k ? "L" : "M"}${x(px).toFixed(1)} ${y(py).toFixed(1)}`).join("");
  paths.names.forEach((of, which) => {
    const stroke = `var(${COLOURS[of]})`;
    const name = which ? "way" : "way observed";
    const all = make("svg:path", { class: isPart ? name : `${name} now`, d: trace(points[which]), stroke });
    clip.append(all);
    if (isPart) clip.append(make("svg:path", { class: `${name} now`, d: trace(points[which].filter((_, k) => inside[k])), stroke }));
  });
  clip.append(make("svg:circle", { cx: x(points[0][0][0]), cy: y(points[0][0][1]), r: 6, fill: "var(--paper)", stroke: "var(--ink)", "stroke-width": 2 }));
  let near = 0;
  t.forEach((one, k) => { if (Math.abs(one - at) < Math.abs(t[near] - at)) near = k; });
  paths.names.forEach((of, which) => clip.append(make("svg:circle", { cx: x(points[which][near][0]), cy: y(points[which][near][1]), r: 5,
    fill: `var(${COLOURS[of]})`, stroke: "var(--paper)", "stroke-width": 1.5 })));
  svg.append(clip, make("svg:rect", { class: "frame", x: edge.left, y: edge.top, width: inner[0], height: inner[1] }));
  const run = runs[piece.run];
  id("way-title").textContent = `Path of ${named(run)} from ${stamp(run, piece.at)} on`;
  const said = paths.errors.map((error, of) => `${error.title.toLowerCase()} ${piece.errors[of].map((values, k) =>
    `${text(values[near], error.step)} ${error.unit} ${paths.names[k + 1]}`).join(", ")}`);
  id("way-said").textContent = `At ${stamp(run, t[near])}: ${said.join("; ")}`;
  svg.onpointermove = svg.onpointerdown = event => {
    const to = svg.getBoundingClientRect(), px = (event.clientX - to.left) * width / to.width, py = (event.clientY - to.top) * height / to.height;
    let best = null, least = 30 ** 2;
    points.forEach(line => line.forEach(([ax, ay], k) => {
      const distance = (x(ax) - px) ** 2 + (y(ay) - py) ** 2;
      if (distance < least && (!isPart || inside[k])) { least = distance; best = k; }
    }));
    if (best == null) return;
    let index = state.at;
    T.forEach((one, k) => { if (Math.abs(one - t[best]) < Math.abs(T[index] - t[best])) index = k; });
    point(index);
  };
}

// Controls.

function choices() {
  const names = [...new Set(plane.panels.map(of => of.title.replace(/, (before|after)$/, "")))];
  const group = (legend, name, all, start, pick) => {
    const fields = make("fieldset", {}, make("legend", {}, legend));
    all.forEach((one, k) => {
      const input = make("input", { type: "radio", name, value: one });
      input.checked = k === start;
      input.addEventListener("change", () => pick(one));
      fields.append(make("label", { class: "choice" }, input, make("span", {}, one)));
    });
    id("choices").append(fields);
  };
  // what is largest first: the yaw where it was measured
  let name = names.includes("yaw") ? "yaw" : names[0], when = "before";
  const pick = () => { state.panel = Math.max(0, plane.panels.findIndex(of => of.title === `${name}, ${when}`)); drawPlane(); };
  group("Residual", "channel", names, names.indexOf(name), one => { name = one; pick(); });
  group("Model", "model", ["before", "after"], 0, one => { when = one; pick(); });
  pick();
}
function cellKeys(event) {
  const from = event.target.closest(".cell");
  if (!from) return;
  const cell = Number(from.dataset.cell), [left, right] = plane.cells[cell];
  const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (event.key === "Enter" || event.key === " ") { choose(cell); event.preventDefault(); return; }
  if (!way) return;
  event.preventDefault();
  let best = null, least = Infinity;
  for (const of of id("plane").querySelectorAll(".cell")) {
    const [l, r] = plane.cells[of.dataset.cell];
    const along = (l - left) * way[0] + (r - right) * way[1], aside = Math.abs((l - left) * way[1]) + Math.abs((r - right) * way[0]);
    if (along > 0 && along + 3 * aside < least) { least = along + 3 * aside; best = of; }
  }
  if (!best) return;
  from.setAttribute("tabindex", -1);
  best.setAttribute("tabindex", 0);
  best.focus();
}
function zoom(factor) {
  const middle = state.at == null ? (state.view[0] + state.view[1]) / 2 : T[state.at], [low, high] = state.view;
  let from = middle - (middle - low) * factor, to = middle + (high - middle) * factor;
  if (from < 0) { to -= from; from = 0; }
  show([Math.max(0, from), Math.min(time.end, to)]);
}
function draw() {
  drawPlane();
  drawPath();
  for (const { of, plot, height } of charts) of.setSize({ width: plot.clientWidth, height });
}

page.hidden = false;
document.documentElement.classList.add("live");
choices();
const planeOf = id("plane");
const under = event => { const cell = event.target.closest && event.target.closest(".cell"); return cell ? Number(cell.dataset.cell) : null; };
planeOf.addEventListener("pointerover", event => pointAt(under(event)));
planeOf.addEventListener("pointerleave", () => pointAt(null));
planeOf.addEventListener("focusin", event => { focused = under(event); pointAt(focused); });
planeOf.addEventListener("focusout", () => pointAt(null));
planeOf.addEventListener("click", event => { const cell = under(event); if (cell != null) choose(cell); });
planeOf.addEventListener("keydown", cellKeys);
if (time) {
  time.panels.forEach((lines, k) => chart(lines, k === time.panels.length - 1));
  const cursor = id("cursor");
  cursor.addEventListener("input", () => point(Number(cursor.value)));
  id("all").addEventListener("click", () => show([0, time.end]));
  id("in").addEventListener("click", () => zoom(0.5));
  id("out").addEventListener("click", () => zoom(2));
  const step = by => () => { const count = chosen().length; state.stretch = (state.stretch + by + count) % count; showStretch(); };
  id("previous").addEventListener("click", step(-1));
  id("next").addEventListener("click", step(1));
  page.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = { "+": () => zoom(0.5), "-": () => zoom(2), "0": () => show([0, time.end]), "n": () => id("next").click(), "p": () => id("previous").click() }[event.key];
    if (act) { act(); event.preventDefault(); }
  });
  show([0, time.end]);
}
let waiting = null;
new ResizeObserver(() => { cancelAnimationFrame(waiting); waiting = requestAnimationFrame(draw); }).observe(page);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { for (const { of } of charts) of.redraw(false, true); });
})();

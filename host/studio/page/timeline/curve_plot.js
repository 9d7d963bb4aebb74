// The curves of the chosen parts over the frames: values, keys, handles, limits. What hands do is in curve_hand.js.

import {clamped, written} from "../numbers.js";
import {Canvas, drawCursor} from "./canvas.js";
import {handlesOf} from "./curve_handles.js";

const kPoint = 4, kHandle = 3.2, kNear = 8, kApart = 34;  // pixels
const kMargin = 26;
const kMostHandles = 24;
const kAxisColor = {x: "axis-x", y: "axis-y", z: "axis-z"};
const kColors = ["accent", "key-eased", "key-spline", "key-linear"];

export class CurvePlot {
  low = -10;
  perValue = 4;      // pixels
  by = {frames: 0, value: 0, line: null};  // by which a hand holds the selected keys
  held = null;       // {handle, at}: a handle that a hand holds
  box = null;

  constructor(data, keys, axis, state) {
    Object.assign(this, {data, keys, axis, state, lines: []});
    this.view = new Canvas((pen, size) => this.#draw(pen, size), (width, height) => this.#resized(width, height));
    this.root = this.view.root;
    this.nothing = document.createElement("p");
    this.nothing.className = "nothing";
    this.nothing.textContent = "Choose rows at the left to see their curves.";
    this.root.append(this.nothing);
    axis.on(() => this.redraw());
    state.on("curves keys rows project poses frame", () => this.redraw());
    state.on("curves", () => this.#newParts());
  }

  redraw() { this.view.redraw(); }
  y(value) { return this.view.height - (value - this.low) * this.perValue; }
  valueAt(y) { return (this.view.height - y) / this.perValue + this.low; }

  zoomValues(y, factor) {
    const at = this.valueAt(y);
    this.perValue = clamped(this.perValue * factor, 0.001, 1e5);
    this.low = at - (this.view.height - y) / this.perValue;
    this.redraw();
  }

  panValues(pixels) {
    this.low += pixels / this.perValue;
    this.redraw();
  }

  // All values of the curves.
  showValues() {
    const all = this.data.lines().flatMap(({values, keys}) => [...values, ...keys.map(({value}) => value)]);
    if (all.length === 0 || this.view.height === 0) return;
    const least = Math.min(...all), most = Math.max(...all), spread = Math.max(most - least, 1e-3 * Math.abs(most), 0.1);
    this.perValue = Math.max(1, this.view.height - 2 * kMargin) / spread;
    this.low = (least + most - spread) / 2 - kMargin / this.perValue;
    this.redraw();
  }

  #resized(_, height) {
    if (this.before > 0) this.perValue *= height / this.before;
    this.before = height;
    this.#newParts();
  }

  // Other curves than before show whole.
  #newParts() {
    if (this.view.height === 0) return;
    const {message} = this.data;
    const shown = message ? JSON.stringify([message.thing, message.parts.map(({name}) => name)]) : "";
    if (shown === this.parts) return;
    this.parts = shown;
    this.showValues();
  }

  // What is nearest: {handle}, {line, index of the key}, or nothing.
  find({x, y}) {
    const away = (at) => Math.hypot(this.axis.x(at.frame) - x, this.y(at.value) - y);
    const points = this.lines.flatMap((line) => line.keys.map(({key, value}, index) => ({line, index, away: away({frame: key.frame, value})})));
    const handles = this.handles().map((handle) => ({handle, away: away(handle.at)}));
    const near = [...points, ...handles].filter((each) => each.away <= kNear).sort((one, other) => one.away - other.away);
    return near[0] ?? {};
  }

  isPicked(line, {key}) { return this.keys.isPicked(line.thing, line.part, key.frame); }

  handles() {
    const made = this.lines.flatMap((line) => line.keys.flatMap((point, i) => this.isPicked(line, point) ? handlesOf(line, i) : []));
    return made.slice(0, kMostHandles);
  }

  #draw(pen, size) {
    const {width, height, colors} = size;
    this.lines = this.data.lines();
    this.nothing.hidden = this.lines.length > 0;
    pen.fillStyle = colors.sheet;
    pen.fillRect(0, 0, width, height);
    this.#outside(pen, size);
    this.#limits(pen, size);
    this.#grid(pen, size);
    this.lines.forEach((line, i) => this.#line(pen, size, line, colorOf(colors, line, i)));
    drawCursor(pen, this.axis.x(this.state.project.frame), height, colors);
    if (this.by.frames === 0 && this.by.value === 0) for (const handle of this.handles()) this.#handle(pen, colors, handle);
    this.lines.forEach((line, i) => this.#points(pen, size, line, colorOf(colors, line, i)));
    this.#numbers(pen, size);
    if (this.box) this.#boxed(pen, colors);
  }

  #outside(pen, {width, height, colors}) {
    pen.fillStyle = colors.band;
    const begin = this.axis.x(0), end = this.axis.x(this.state.project.frames - 1);
    if (begin > 0) pen.fillRect(0, 0, begin, height);
    if (end < width) pen.fillRect(end, 0, width - end, height);
  }

  // Of one line only: several bands over each other say nothing.
  #limits(pen, {width, height, colors}) {
    const limited = this.lines.filter(({limits}) => limits);
    const shown = limited.length === 1 ? limited : limited.filter((line) => line.keys.some((point) => this.isPicked(line, point)) && this.by.line === line);
    for (const line of shown) {
      const [lower, upper] = line.limits, top = this.y(upper), bottom = this.y(lower);
      pen.fillStyle = colors[kAxisColor[line.axis]] ?? colors.accent;
      pen.globalAlpha = 0.07;
      pen.fillRect(0, top, width, bottom - top);
      pen.globalAlpha = 0.5;
      for (const y of [top, bottom]) pen.fillRect(0, Math.round(y), width, 1);
      pen.globalAlpha = 1;
    }
  }

  #steps(height) {
    let step = 1e-3;
    for (let i = 0; step * this.perValue < kApart; ++i) step *= [2, 2.5, 2][i % 3];
    const list = [];
    for (let at = Math.ceil(this.low / step); at * step * this.perValue < height + this.low * this.perValue; ++at) list.push(at * step);
    return list;
  }

  #grid(pen, {width, height, colors}) {
    pen.fillStyle = colors.grid;
    for (const frame of this.axis.steps().frames) pen.fillRect(Math.round(this.axis.x(frame)), 0, 1, height);
    for (const value of this.#steps(height)) pen.fillRect(0, Math.round(this.y(value)), width, 1);
    pen.fillStyle = colors["edge-strong"];
    pen.fillRect(0, Math.round(this.y(0)), width, 1);
  }

  #numbers(pen, {height, colors}) {
    pen.textAlign = "left";
    pen.lineWidth = 3;
    pen.strokeStyle = colors.sheet;
    for (const value of this.#steps(height)) {
      pen.fillStyle = colors.muted;
      pen.strokeText(written(value, 3), 5, this.y(value) - 7);
      pen.fillText(written(value, 3), 5, this.y(value) - 7);
    }
  }

  #line(pen, {width}, {values, first}, color) {
    pen.beginPath();
    const begin = clamped(Math.floor(this.axis.from) - first, 0, values.length), every = Math.max(1, Math.floor(0.5 / this.axis.perFrame));
    for (let i = begin; i < values.length; i += every) {
      const x = this.axis.x(first + i);
      pen.lineTo(x, this.y(values[i]));
      if (x > width) break;
    }
    pen.strokeStyle = color;
    pen.lineWidth = 1.6;
    pen.lineJoin = "round";
    pen.stroke();
  }

  #points(pen, {colors}, line, color) {
    for (const point of line.keys) {
      const picked = this.isPicked(line, point), held = picked ? this.by : {frames: 0, value: 0};
      const sameLine = held.line && held.line.part === line.part && held.line.axis === line.axis;
      const x = this.axis.x(point.key.frame + held.frames), y = this.y(point.value + (sameLine ? held.value : 0));
      pen.beginPath();
      pen.arc(x, y, picked ? kPoint + 0.6 : kPoint, 0, 2 * Math.PI);
      pen.fillStyle = picked ? colors.accent : color;
      pen.fill();
      pen.lineWidth = 1.5;
      pen.strokeStyle = picked ? colors.text : colors.sheet;
      pen.stroke();
    }
  }

  #handle(pen, colors, handle) {
    const at = this.held && same(this.held.handle, handle) ? this.held.at : handle.at;
    const x = this.axis.x(at.frame), y = this.y(at.value);
    pen.beginPath();
    pen.moveTo(this.axis.x(handle.from.frame), this.y(handle.from.value));
    pen.lineTo(x, y);
    pen.strokeStyle = colors.muted;
    pen.lineWidth = 1;
    pen.stroke();
    pen.beginPath();
    if (handle.kind.startsWith("ease")) pen.rect(x - kHandle, y - kHandle, 2 * kHandle, 2 * kHandle);
    else pen.arc(x, y, kHandle, 0, 2 * Math.PI);
    pen.fillStyle = colors.sheet;
    pen.fill();
    pen.strokeStyle = colors.text;
    pen.lineWidth = 1.5;
    pen.stroke();
  }

  #boxed(pen, colors) {
    const {x, y, toX, toY} = this.box;
    pen.strokeStyle = colors.accent;
    pen.lineWidth = 1;
    pen.strokeRect(x + 0.5, y + 0.5, toX - x, toY - y);
  }
}

const same = (one, other) => one.kind === other.kind && one.index === other.index && one.line.part === other.line.part && one.line.axis === other.line.axis;
const colorOf = (colors, {axis}, i) => colors[kAxisColor[axis] ?? kColors[i % kColors.length]];

// The curves of the chosen parts over the frames: values, keys, handles, limits. What hands do is in curve_hand.js.

import {element} from "../dom.js";
import {clamped} from "../numbers.js";
import {Canvas, drawBox, drawCursor, drawOutside} from "./canvas.js";
import {handlesOf} from "./curve_handles.js";
import {colorOf, drawGrid, drawHandle, drawLimits, drawLine, drawNumbers, drawPoint} from "./curve_paint.js";

const kNear = 8;      // pixels from a point's middle at which it is meant
const kMargin = 26;   // above and below curves that show whole
const kMostHandles = 24;
const kApart = 18;    // pixels between the points of dense keys

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
    this.nothing = element("p", {class: "nothing"}, "Choose rows at the left to see their curves.");
    this.root.append(this.nothing);
    axis.on(() => this.redraw());
    state.on("curves keys rows project poses frame", () => this.redraw());
    state.on("curves", () => this.#newParts());
  }

  redraw() { this.view.redraw(); }
  x(frame) { return this.axis.x(frame); }
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

  // Those that a mouse can tell from their keys.
  handles() {
    const made = this.lines.flatMap((line) => line.keys.flatMap((point, i) => this.isPicked(line, point) ? handlesOf(line, i) : []));
    const isApart = ({from, at}) => Math.hypot(this.x(at.frame) - this.x(from.frame), this.y(at.value) - this.y(from.value)) >= kNear;
    return made.filter(isApart).slice(0, kMostHandles);
  }

  #draw(pen, size) {
    const {width, height, colors} = size, {frame, frames} = this.state.project;
    this.lines = this.data.lines();
    this.nothing.hidden = this.lines.length > 0;
    pen.fillStyle = colors.sheet;
    pen.fillRect(0, 0, width, height);
    drawOutside(pen, size, this.axis, frames);
    for (const line of this.lines) if (line.limits && (this.lines.length === 1 || same(line, this.by.line))) drawLimits(pen, size, this, line);
    drawGrid(pen, size, this, this.axis.steps().frames);
    this.lines.forEach((line, i) => drawLine(pen, size, this, line, colorOf(colors, line, i)));
    drawCursor(pen, this.x(frame), height, colors);
    if (!this.by.line) for (const handle of this.handles()) drawHandle(pen, colors, this, handle, this.#atOf(handle));
    this.lines.forEach((line, i) => this.#points(pen, size, line, colorOf(colors, line, i)));
    drawNumbers(pen, size, this);
    if (this.box) drawBox(pen, colors, this.box);
  }

  // Where it is held, or else where it is.
  #atOf(handle) {
    const {handle: held, at} = this.held ?? {};
    return held && held.kind === handle.kind && held.index === handle.index && same(held.line, handle.line) ? at : handle.at;
  }

  // Where keys are dense only some of them show, so that the curve does; of selected and of other ones each.
  #points(pen, {width, colors}, line, color) {
    const last = {};
    for (const point of line.keys) {
      const picked = this.isPicked(line, point);
      const x = this.x(point.key.frame + (picked ? this.by.frames : 0));
      const y = this.y(point.value + (picked && same(line, this.by.line) ? this.by.value : 0));
      if (x < -kApart || x > width + kApart || (last[picked] && Math.hypot(x - last[picked].x, y - last[picked].y) < kApart)) continue;
      last[picked] = {x, y};
      drawPoint(pen, colors, x, y, picked, color);
    }
  }
}

const same = (one, other) => other !== null && one.part === other.part && one.axis === other.axis;

// The frames' numbers above the sheet: a drag scrubs, arrows step, the ends of the play range are pulled.

import {written} from "../numbers.js";
import {Canvas, drawCursor} from "./canvas.js";

const kGrip = 7;   // pixels around an end of the play range
const kBand = 5;   // height of the play range

export class Ruler {
  #held = null;  // "frame", "first" or "last"

  constructor({state, frames}, axis) {
    Object.assign(this, {state, frames, axis});
    this.view = new Canvas((pen, size) => this.#draw(pen, size), (width) => { if (width > 0) axis.resize(width); });
    this.root = this.view.root;
    this.root.classList.add("ruler");
    for (const [key, value] of [["role", "slider"], ["tabindex", 0], ["aria-label", "Frame"], ["data-key", "ruler"]]) this.root.setAttribute(key, value);
    this.root.title = "Drag: go to a frame. Ends of the band above: the play range; double click: all";
    this.root.addEventListener("pointerdown", (event) => this.#down(event));
    this.root.addEventListener("pointermove", (event) => this.#move(event));
    this.root.addEventListener("pointerup", () => { this.#held = null; });
    this.root.addEventListener("lostpointercapture", () => { this.#held = null; });
    this.root.addEventListener("dblclick", () => state.set("range", null));
    this.root.addEventListener("keydown", (event) => this.#key(event));
    axis.on(() => this.view.redraw());
    state.on("project poses frame range", () => this.#show());
  }

  #show() {
    if (!this.state.isFilm()) return;
    const {frame, frames} = this.state.project;
    this.root.setAttribute("aria-valuemin", 0);
    this.root.setAttribute("aria-valuemax", frames - 1);
    this.root.setAttribute("aria-valuenow", frame);
    this.view.redraw();
  }

  #endAt({x, y}) {
    if (y > 2 * kBand) return null;
    const [first, last] = this.frames.range();
    return Math.abs(x - this.axis.x(last)) < kGrip ? "last" : Math.abs(x - this.axis.x(first)) < kGrip ? "first" : null;
  }

  #down(event) {
    if (event.button !== 0) return;
    this.root.setPointerCapture(event.pointerId);
    this.#held = this.#endAt(this.view.spot(event)) ?? "frame";
    this.#move(event);
  }

  #move(event) {
    const spot = this.view.spot(event);
    if (!this.#held) {
      this.root.style.cursor = this.#endAt(spot) ? "ew-resize" : "";
      return;
    }
    const frame = Math.round(this.axis.frameAt(spot.x));
    if (this.#held === "frame") return this.frames.scrub(frame, event);
    const [first, last] = this.frames.range();
    this.frames.setRange(...(this.#held === "first" ? [frame, last] : [first, frame]));
  }

  #key(event) {
    const by = {ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10}[event.key];
    if (by === undefined || event.ctrlKey || event.altKey) return;
    event.preventDefault();
    this.frames.step(by * (event.shiftKey ? 10 : 1), event);
  }

  #draw(pen, {width, height, colors}) {
    const {project} = this.state;
    const [first, last] = this.frames.range();
    pen.fillStyle = colors.surface;
    pen.fillRect(0, 0, width, height);
    pen.fillStyle = colors["edge-strong"];
    pen.fillRect(this.axis.x(first), 0, this.axis.x(last) - this.axis.x(first), kBand);
    pen.fillStyle = colors.muted;
    for (const end of [first, last]) pen.fillRect(Math.round(this.axis.x(end)) - 2, 0, 4, kBand + 3);
    this.#numbers(pen, {width, height, colors}, project.frames);
    this.#flag(pen, {height, colors}, project.frame);
  }

  #numbers(pen, {width, height, colors}, frames) {
    pen.textAlign = "center";
    for (const frame of this.axis.steps().frames) {
      const x = this.axis.x(frame);
      pen.fillStyle = frame < frames ? colors.muted : colors["edge-strong"];
      if (x < width - 2 * kGrip) pen.fillText(frame, x, height / 2 + 3);
      pen.fillStyle = colors["edge-strong"];
      pen.fillRect(Math.round(x), height - 4, 1, 4);
    }
  }

  #flag(pen, {height, colors}, frame) {
    const x = this.axis.x(frame), text = written(frame), wide = pen.measureText(text).width + 12;
    drawCursor(pen, x, height, colors);
    pen.fillStyle = colors.accent;
    pen.beginPath();
    pen.roundRect(x - wide / 2, height / 2 - 5, wide, 16, 4);
    pen.fill();
    pen.fillStyle = colors["on-accent"];
    pen.fillText(text, x, height / 2 + 3.5);
  }
}

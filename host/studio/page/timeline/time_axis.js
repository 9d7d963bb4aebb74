// Which frames show and where: shared by the ruler, the sheet and the curves. Pixels count from their left edge.

import {clamped} from "../numbers.js";

const kLeast = 0.02, kMost = 80;  // pixels a frame
const kMargin = 18;               // pixels beside the film when all of it shows
const kApart = 56;                // pixels between two numbers

export class TimeAxis {
  #listeners = [];
  #whole = true;  // all of the film shows, also when its length changes
  #frames = 1;
  from = 0;
  perFrame = 8;
  width = 0;

  on(listener) { this.#listeners.push(listener); }

  x(frame) { return (frame - this.from) * this.perFrame; }
  frameAt(x) { return x / this.perFrame + this.from; }

  resize(width) { this.width = width; this.#again(); }
  setFrames(frames) { this.#frames = frames; this.#again(); }

  showAll() { this.#whole = true; this.#again(); }

  zoom(x, factor) {
    const at = this.frameAt(x);
    this.#whole = false;
    this.perFrame = clamped(this.perFrame * factor, kLeast, kMost);
    this.#go(at - x / this.perFrame);
  }

  pan(pixels) {
    this.#whole = false;
    this.#go(this.from - pixels / this.perFrame);
  }

  // So that the frame shows.
  reveal(frame) {
    const x = this.x(frame);
    if (x < 0) this.pan(kMargin - x);
    else if (x > this.width) this.pan(this.width - kMargin - x);
  }

  // Frames that have a number, so far apart that the numbers can be read.
  steps() {
    let step = 1;
    for (const factors = [2, 2.5, 2]; step * this.perFrame < kApart;) {
      const factor = factors.shift();
      step *= factor;
      factors.push(factor);
    }
    return {step, frames: this.#every(step)};
  }

  #every(step) {
    const list = [];
    for (let frame = Math.max(0, Math.ceil(this.from / step) * step); this.x(frame) <= this.width; frame += step) list.push(frame);
    return list;
  }

  #again() {
    if (this.width === 0) return;
    if (!this.#whole) return this.#tell();
    this.perFrame = clamped((this.width - 2 * kMargin) / Math.max(1, this.#frames - 1), kLeast, kMost);
    this.#go(-kMargin / this.perFrame);
  }

  #go(from) {
    this.from = Math.max(-this.width / this.perFrame + 1, from);
    this.#tell();
  }

  #tell() { for (const listener of this.#listeners) listener(); }
}

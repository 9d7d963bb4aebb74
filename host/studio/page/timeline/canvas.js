// A canvas as large as its place, drawn at most once an animation frame, in the theme's colours.

import {element} from "../dom.js";

const kColors = ["sheet", "lane", "grid", "band", "surface", "edge-strong", "text", "muted", "accent", "on-accent", "selected", "axis-x",
                 "axis-y", "axis-z", "key-linear", "key-eased", "key-spline", "key-hold"];
const kFont = "11px";

function themeColors() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries([...kColors.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
                             ["font", `${kFont} ${style.getPropertyValue("--font")}`]]);
}

export class Canvas {
  #asked = false;

  // `draw(pen, {width, height, colors})`, in pixels of CSS; `resized(width, height)`.
  constructor(draw, resized = () => {}) {
    Object.assign(this, {draw, resized, width: 0, height: 0});
    this.canvas = element("canvas", {"aria-hidden": "true"});
    this.root = element("div", {class: "drawing"}, this.canvas);
    new ResizeObserver(([{contentRect}]) => this.#resize(contentRect)).observe(this.root);
    new MutationObserver(() => this.redraw()).observe(document.documentElement, {attributeFilter: ["data-theme"]});
  }

  redraw() {
    if (this.#asked || this.width === 0 || this.height === 0) return;
    this.#asked = true;
    requestAnimationFrame(() => this.#draw());
  }

  // Of a mouse's event, in pixels of CSS.
  spot({clientX, clientY}) {
    const {left, top} = this.root.getBoundingClientRect();
    return {x: clientX - left, y: clientY - top};
  }

  #resize({width, height}) {
    Object.assign(this, {width, height});
    this.resized(width, height);
    this.redraw();
  }

  #draw() {
    this.#asked = false;
    const {canvas, width, height} = this, scale = devicePixelRatio;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    const pen = canvas.getContext("2d");
    pen.scale(scale, scale);
    const colors = themeColors();
    pen.font = colors.font;
    pen.textBaseline = "middle";
    this.draw(pen, {width, height, colors});
  }
}

// The frame that shows, over all of a drawing's height.
export function drawCursor(pen, x, height, colors) {
  pen.fillStyle = colors.accent;
  pen.fillRect(Math.round(x) - 0.75, 0, 1.5, height);
}

// Frames that the film has not are darker.
export function drawOutside(pen, {width, height, colors}, axis, frames) {
  pen.fillStyle = colors.band;
  const begin = axis.x(0), end = axis.x(frames - 1);
  if (begin > 0) pen.fillRect(0, 0, begin, height);
  if (end < width) pen.fillRect(end, 0, width - end, height);
}

// That a hand draws.
export function drawBox(pen, colors, {x, y, toX, toY}) {
  pen.fillStyle = colors.accent;
  pen.globalAlpha = 0.14;
  pen.fillRect(x, y, toX - x, toY - y);
  pen.globalAlpha = 1;
  pen.lineWidth = 1;
  pen.strokeStyle = colors.accent;
  pen.strokeRect(x + 0.5, y + 0.5, toX - x, toY - y);
}

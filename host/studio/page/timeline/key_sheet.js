// The dope sheet: a row of diamonds for each thing and part, as row_list.js has them. What hands do is in sheet_hand.js.

import {Canvas, drawBox, drawCursor, drawOutside} from "./canvas.js";
import {kRow} from "./row_list.js";
import {firstFrom} from "./rows.js";

const kSize = 4.6;     // half a diamond's width, in pixels
const kClose = 2;      // pixels: marks closer than this are one
const kNear = 6;       // pixels to all sides of a mark's middle at which it is meant

// Each ease has a shape and a colour.
const kShapes = {
  linear: (pen, x, y, size) => diamond(pen, x, y, size),
  eased: (pen, x, y, size) => pen.roundRect(x - size * 0.8, y - size * 0.8, size * 1.6, size * 1.6, 1),
  spline: (pen, x, y, size) => pen.arc(x, y, size * 0.92, 0, 2 * Math.PI),
  slopes: (pen, x, y, size) => pen.arc(x, y, size * 0.92, 0, 2 * Math.PI),
  hold: (pen, x, y, size) => flag(pen, x, y, size),
};
const kColors = {linear: "key-linear", eased: "key-eased", spline: "key-spline", slopes: "key-spline", hold: "key-hold"};

function diamond(pen, x, y, size) {
  pen.moveTo(x, y - size);
  pen.lineTo(x + size, y);
  pen.lineTo(x, y + size);
  pen.lineTo(x - size, y);
  pen.closePath();
}

// Half a diamond: its right side is where the value stands still.
function flag(pen, x, y, size) {
  pen.moveTo(x + 1, y - size);
  pen.lineTo(x + 1, y + size);
  pen.lineTo(x - size, y);
  pen.closePath();
}

export class KeySheet {
  box = null;  // {x, y, toX, toY} while a hand draws one
  by = 0;      // frames by which a hand holds the selected keys
  copies = false;

  constructor(rows, rowList, keys, axis, state) {
    Object.assign(this, {rows, rowList, keys, axis, state});
    this.view = new Canvas((pen, size) => this.#draw(pen, size));
    this.root = this.view.root;
    axis.on(() => this.redraw());
    state.on("keys rows scrolled project poses frame range", () => this.redraw());
  }

  redraw() { this.view.redraw(); }

  // What is there: {row, mark}, both may be null.
  find({x, y}) {
    const row = this.rowList.rowAt(y);
    const middle = (this.rowList.index(y) + 0.5) * kRow - this.rowList.top;
    if (!row || Math.abs(y - middle) > kNear) return {row, mark: null};
    const marks = this.rows.marks(row);
    const at = firstFrom(marks, this.axis.frameAt(x - kNear));
    const near = marks.slice(at, at + 40).filter(({frame}) => Math.abs(this.axis.x(frame) - x) <= kNear);
    near.sort((one, other) => Math.abs(this.axis.x(one.frame) - x) - Math.abs(this.axis.x(other.frame) - x));
    return {row, mark: near[0] ?? null};
  }

  keysIn({x, y, toX, toY}) {
    const [left, right] = [x, toX].sort((one, other) => one - other);
    const [above, below] = [y, toY].sort((one, other) => one - other);
    const top = this.rowList.top;
    const inside = this.rows.list.filter((_, i) => (i + 1) * kRow > above + top && i * kRow < below + top);
    return inside.flatMap((row) => this.rows.marks(row)).filter(({frame}) => this.axis.x(frame) >= left && this.axis.x(frame) <= right)
      .flatMap(({keys}) => keys);
  }

  #draw(pen, size) {
    const {width, height, colors} = size, {project} = this.state, top = this.rowList.top;
    pen.fillStyle = colors.sheet;
    pen.fillRect(0, 0, width, height);
    const first = Math.max(0, Math.floor(top / kRow));
    const seen = this.rows.list.slice(first, first + Math.ceil(height / kRow) + 1);
    seen.forEach((row, i) => this.#lane(pen, size, row, (first + i) * kRow - top));
    this.#grid(pen, size);
    drawOutside(pen, size, this.axis, project.frames);
    seen.forEach((row, i) => this.#marks(pen, size, row, (first + i) * kRow - top + kRow / 2));
    drawCursor(pen, this.axis.x(project.frame), height, colors);
    if (this.box) drawBox(pen, colors, this.box);
  }

  #lane(pen, {width, colors}, row, y) {
    pen.fillStyle = this.rows.chosen.has(row.id) ? colors.selected : row.level === 0 ? colors.lane : colors.sheet;
    pen.fillRect(0, y, width, kRow - 1);
  }

  #grid(pen, {height, colors}) {
    pen.fillStyle = colors.grid;
    for (const frame of this.axis.steps().frames) pen.fillRect(Math.round(this.axis.x(frame)), 0, 1, height);
  }

  #marks(pen, {width, colors}, row, y) {
    const marks = this.rows.marks(row);
    let last = -Infinity;
    for (let i = Math.max(0, firstFrom(marks, this.axis.from) - 1); i < marks.length; ++i) {
      const mark = marks[i], x = this.axis.x(mark.frame);
      if (x > width + kSize && this.by === 0) break;
      const picked = mark.keys.some(({thing, part, frame}) => this.keys.isPicked(thing, part, frame));
      if (mark.still && marks[i + 1]) this.#hold(pen, colors, x, this.axis.x(marks[i + 1].frame), y);
      if (x - last < kClose && !picked) continue;
      last = x;
      if (picked && this.by !== 0) this.#held(pen, colors, mark, x, y);
      else drawMark(pen, colors, mark.look, x, y, picked);
    }
  }

  // From key to key nothing changes.
  #hold(pen, colors, x, to, y) {
    pen.fillStyle = colors["edge-strong"];
    pen.fillRect(x, y - 2, to - x, 4);
  }

  #held(pen, colors, mark, x, y) {
    pen.globalAlpha = this.copies ? 1 : 0.35;
    drawMark(pen, colors, mark.look, x, y, false);
    pen.globalAlpha = 1;
    drawMark(pen, colors, mark.look, this.axis.x(mark.frame + this.by), y, true);
  }
}

function drawMark(pen, colors, look, x, y, picked) {
  pen.beginPath();
  kShapes[look](pen, x, y, picked ? kSize + 0.8 : kSize);
  pen.fillStyle = picked ? colors.accent : colors[kColors[look]];
  pen.fill();
  pen.lineWidth = picked ? 1.4 : 1;
  pen.strokeStyle = picked ? colors.text : colors.sheet;
  pen.stroke();
  if (look !== "slopes") return;
  pen.beginPath();
  pen.moveTo(x - kSize - 3, y + 3);
  pen.lineTo(x + kSize + 3, y - 3);
  pen.strokeStyle = picked ? colors.accent : colors[kColors[look]];
  pen.stroke();
}

// The picture of the frame being drawn (binary messages of view 255), with overlays of what the nodes do for it.

import {element} from "../dom.js";
import {nodeColor} from "./colors.js";

export const kRenderingView = 255;
const kOverlays = [["lines", "Lines", "Who draws which lines: a colour for each node"],
                   ["ebc", "Work", "How much work each line is: its edge boxes (EBC)"],
                   ["moving", "Moving", "What moves, tinted, over what stands still, dimmed"],
                   ["blocks", "Blocks", "Blocks that are flagged: those that nodes send"]];
const kBarShare = 0.25;  // of the width: the longest bar of the EBC

export class DrawnFrame {
  #drawn = null;
  #on = new Set();

  constructor(painter) {
    this.canvas = element("canvas", {width: 1, height: 1, "aria-label": "The frame that is being drawn", role: "img"});
    this.overlay = element("canvas", {class: "overlay", width: 1, height: 1, "aria-hidden": "true"});
    this.context = this.canvas.getContext("2d", {alpha: false});
    this.empty = element("p", {class: "nothing"}, "Frames show here as nodes draw them.");
    this.root = element("div", {class: "drawn"}, element("div", {class: "sheet"}, this.canvas, this.overlay), this.empty);
    this.switches = element("div", {class: "group switches", role: "group", "aria-label": "Overlays"}, kOverlays.map((each) => this.#switch(each)));
    painter.add(kRenderingView, this);
  }

  painting({width, height}) {
    this.empty.hidden = true;
    if (this.canvas.width === width && this.canvas.height === height) return;
    Object.assign(this.canvas, {width, height});
    Object.assign(this.overlay, {width, height});
    this.#draw();
  }

  describe(drawn) {
    this.#drawn = drawn;
    this.#draw();
  }

  #switch([name, text, tip]) {
    const button = element("button", {"aria-pressed": "false", title: tip, "data-overlay": name}, text);
    button.addEventListener("click", () => {
      const on = !this.#on.has(name);
      if (on) this.#on.add(name);
      else this.#on.delete(name);
      button.setAttribute("aria-pressed", String(on));
      this.#draw();
    });
    return button;
  }

  #draw() {
    const pen = this.overlay.getContext("2d");
    pen.clearRect(0, 0, this.overlay.width, this.overlay.height);
    if (!this.#drawn) return;
    const {moving, still, flagged} = this.#drawn;
    if (this.#on.has("moving")) {
      pen.fillStyle = "rgb(12 14 18 / 0.6)";
      this.#eachBlock(still, (x, y, side) => pen.fillRect(x, y, side, side));
      this.#eachBlock(moving, (x, y, side) => pen.clearRect(x, y, side, side));
      pen.fillStyle = "rgb(229 134 87 / 0.3)";
      this.#eachBlock(moving, (x, y, side) => pen.fillRect(x, y, side, side));
    }
    if (this.#on.has("lines")) this.#lines(pen);
    if (this.#on.has("ebc")) this.#ebc(pen);
    if (this.#on.has("blocks")) {
      pen.strokeStyle = "rgb(255 255 255 / 0.75)";
      this.#eachBlock(flagged, (x, y, side) => pen.strokeRect(x + 0.5, y + 0.5, side - 1, side - 1));
    }
  }

  #lines(pen) {
    for (const {node, lines} of this.#drawn.nodes ?? []) {
      for (const [first, last] of lines ?? []) {
        pen.fillStyle = nodeColor(node, 0.3);
        pen.fillRect(0, first, this.overlay.width, last - first + 1);
        pen.fillStyle = nodeColor(node);
        pen.fillRect(0, first, 6, last - first + 1);
      }
    }
  }

  // From the right: a bar for each line, or for each of as many parts of the height as were sent.
  #ebc(pen) {
    const counts = this.#drawn.ebc ?? [];
    const most = Math.max(1, ...counts);
    const height = this.overlay.height / (counts.length || 1);
    pen.fillStyle = "rgb(224 123 79 / 0.8)";
    counts.forEach((count, i) => {
      const width = count / most * kBarShare * this.overlay.width;
      pen.fillRect(this.overlay.width - width, i * height, width, Math.max(1, height - (height > 3 ? 1 : 0)));
    });
  }

  // Those whose bit is set: the lowest of a byte first, block after block in rows.
  #eachBlock(flags = "", act) {
    const {block} = this.#drawn;
    const bits = atob(flags);
    const columns = Math.ceil(this.overlay.width / block), rows = Math.ceil(this.overlay.height / block);
    for (let row = 0; row < rows; ++row) {
      for (let column = 0; column < columns; ++column) {
        const bit = row * columns + column;
        if (bits.charCodeAt(bit >> 3) >> (bit & 7) & 1) act(column * block, row * block, block);
      }
    }
  }
}

// What each node did for the last frames: a row a node, a group of phases a frame, as long as they took.

import {element} from "../dom.js";
import {kPhases, nodeColor, phaseColor} from "./colors.js";

const kFrames = 24, kRow = 16, kGap = 2, kNames = 96, kMostRows = 12;  // pixels

export class LoadTimeline {
  #drawn = [];
  #nodes = [];

  constructor() {
    this.canvas = element("canvas", {role: "img", "aria-label": "What each node did for the last frames"});
    this.legend = element("ul", {class: "legend", "aria-label": "Phases"}, kPhases.map(([, name, color]) => {
      const dot = element("i", {});
      dot.style.background = color;
      return element("li", {}, dot, name);
    }));
    this.root = element("div", {class: "load", hidden: true}, this.canvas, this.legend);
    new ResizeObserver(() => this.#draw()).observe(this.root);
  }

  clear() { this.#drawn = []; this.#draw(); }
  setNodes(nodes) { this.#nodes = nodes; this.#draw(); }

  add(drawn) {
    this.#drawn = [...this.#drawn, drawn].slice(-kFrames);
    this.#draw();
  }

  #rows() {
    const seen = new Set(this.#drawn.flatMap(({nodes}) => (nodes ?? []).map(({node}) => node)));
    return [...seen].sort((one, other) => one - other).slice(0, kMostRows);
  }

  #draw() {
    const rows = this.#rows();
    this.root.hidden = rows.length === 0;
    if (this.root.hidden || this.root.clientWidth === 0) return;
    const scale = devicePixelRatio, width = this.root.clientWidth - 24, height = rows.length * (kRow + kGap);
    Object.assign(this.canvas, {width: width * scale, height: height * scale});
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    const pen = this.canvas.getContext("2d");
    pen.scale(scale, scale);
    const longest = this.#drawn.map(({nodes}) => Math.max(...(nodes ?? []).map(total), 1e-6));
    const perSecond = (width - kNames) / longest.reduce((sum, each) => sum + each, 0);
    rows.forEach((node, row) => this.#row(pen, node, row * (kRow + kGap), longest, perSecond));
  }

  #row(pen, node, y, longest, perSecond) {
    pen.fillStyle = nodeColor(node);
    pen.fillRect(0, y + 3, 4, kRow - 6);
    const {color, fontFamily} = getComputedStyle(this.root);
    pen.fillStyle = color;
    pen.font = `11px ${fontFamily}`;
    pen.textBaseline = "middle";
    pen.fillText(this.#nodes[node]?.name ?? `node ${node}`, 10, y + kRow / 2, kNames - 16);
    let from = kNames;
    this.#drawn.forEach(({nodes}, i) => {
      let x = from;
      for (const [phase, seconds] of Object.entries((nodes ?? []).find((each) => each.node === node)?.seconds ?? {})) {
        pen.fillStyle = phaseColor(phase);
        pen.fillRect(x, y, Math.max(0, seconds * perSecond - 0.5), kRow);
        x += seconds * perSecond;
      }
      from += longest[i] * perSecond;
    });
  }
}

const total = ({seconds}) => Object.values(seconds ?? {}).reduce((sum, each) => sum + each, 0);

// Icons of 16 x 16, drawn with one pen in the text's colour.

import {svg} from "./dom.js";

const kPaths = {
  undo: "M6 3 2.5 6.5 6 10 M2.5 6.5 H10 a3.5 3.5 0 0 1 0 7 H7",
  redo: "M10 3 13.5 6.5 10 10 M13.5 6.5 H6 a3.5 3.5 0 0 0 0 7 H9",
  none: "M4 2.5 V12.5 L6.8 10 L8.6 13.8 L10.3 13 L8.6 9.3 L12 9 Z",
  move: "M8 1.5 V14.5 M1.5 8 H14.5 M6 3.5 8 1.5 10 3.5 M6 12.5 8 14.5 10 12.5 M3.5 6 1.5 8 3.5 10 M12.5 6 14.5 8 12.5 10",
  turn: "M13.5 8 a5.5 5.5 0 1 1 -2 -4.2 M13.5 1.8 V5 H10.3",
  axes: "M6 10 V2 M4.3 3.8 6 2 7.7 3.8 M6 10 H14 M12.2 8.3 14 10 12.2 11.7 M6 10 2.2 13.8 M2.2 11.4 V13.8 H4.6",
  box: "M8 1.8 13.5 4.8 V11.2 L8 14.2 L2.5 11.2 V4.8 Z M2.5 4.8 8 7.8 13.5 4.8 M8 7.8 V14.2",
  points: "M3.5 12.5 C4.5 5 11.5 11 12.5 3.5 M2.2 11.2 h2.6 v2.6 h-2.6 z M11.2 2.2 h2.6 v2.6 h-2.6 z",
  sun: "M8 5 a3 3 0 1 0 0.01 0 Z M8 1 V2.6 M8 13.4 V15 M1 8 H2.6 M13.4 8 H15 M3 3 4.2 4.2 M11.8 11.8 13 13 M3 13 4.2 11.8 M11.8 4.2 13 3",
  moon: "M13 9.8 A5.8 5.8 0 0 1 6.2 3 A5.8 5.8 0 1 0 13 9.8 Z",
  help: "M8 1.8 a6.2 6.2 0 1 0 0.01 0 Z M6.2 6.4 a1.9 1.9 0 1 1 2.7 1.8 q-0.9 0.4 -0.9 1.4 M8 11.6 v0.2",
  chevron: "M4.5 6.2 8 9.8 11.5 6.2",
  twist: "M6.2 4.5 9.8 8 6.2 11.5",
  check: "M3.5 8.5 6.5 11.5 12.5 4.5",
  close: "M4 4 12 12 M12 4 4 12",
  add: "M8 3 V13 M3 8 H13",
  remove: "M3 4.5 H13 M6.5 4.5 V2.8 H9.5 V4.5 M4.3 4.5 5 13.5 H11 L11.7 4.5 M6.8 7 V11 M9.2 7 V11",
  mirror: "M8 2 V14 M5.8 4.5 2 11.5 H5.8 Z M10.2 4.5 14 11.5 H10.2 Z",
  maximise: "M2.5 6 V2.5 H6 M10 2.5 H13.5 V6 M13.5 10 V13.5 H10 M6 13.5 H2.5 V10",
  restore: "M6 2.5 V6 H2.5 M13.5 6 H10 V2.5 M10 13.5 V10 H13.5 M2.5 10 H6 V13.5",
  key: "M8 3 12.5 8 8 13 3.5 8 Z",
  reset: "M3 8 a5 5 0 1 0 1.6 -3.7 M4.2 1.8 V4.7 H7.1",
  play: "M4.5 2.8 13 8 4.5 13.2 Z",
  pause: "M5 3 V13 M11 3 V13",
  stop: "M4 4 H12 V12 H4 Z",
  next: "M6 3.5 10.5 8 6 12.5",
  before: "M10 3.5 5.5 8 10 12.5",
  last: "M4 3.5 9.5 8 4 12.5 Z M12 3.5 V12.5",
  first: "M12 3.5 6.5 8 12 12.5 Z M4 3.5 V12.5",
  render: "M2 4.5 H14 V13 H2 Z M2 4.5 3.4 2 H5.6 L4.2 4.5 M7 4.5 8.4 2 H10.6 L9.2 4.5 M12 4.5 13.2 2",
  scene: "M8 2 a2 2 0 1 0 0.01 0 Z M8 6 V10 M8 10 5 14.5 M8 10 11 14.5 M3.5 7.8 H12.5",
  camera: "M1.8 4.5 H10.2 V11.5 H1.8 Z M10.2 7 14.2 4.8 V11.2 L10.2 9",
  actor: "M8 2 a2.6 2.6 0 1 0 0.01 0 Z M3 14 a5 4.6 0 0 1 10 0 Z",
  joint: "M8 5.6 a2.4 2.4 0 1 0 0.01 0 Z",
  insert: "M7 4 11 8.5 7 13 3 8.5 Z M12.5 1.8 V6.2 M10.3 4 H14.7",
  ease: "M2 13.5 C8 13.5 8 2.5 14 2.5 M2 2.5 V13.5 H14",
  time: "M8 1.8 a6.2 6.2 0 1 0 0.01 0 Z M8 4.5 V8 L10.8 9.8",
  prompt: "M3 4 7 8 3 12 M8.5 12.5 H13.5",
  copy: "M5.5 5.5 H13.5 V13.5 H5.5 Z M10.5 5.5 V2.5 H2.5 V10.5 H5.5",
  drop: "M8 2 C11 6 12.3 8 12.3 10 a4.3 4.3 0 0 1 -8.6 0 C3.7 8 5 6 8 2 Z",
  ghosts: "M5 2.6 a2 2 0 1 0 0.01 0 Z M5 6.6 V14 M11 4.6 a1.6 1.6 0 1 0 0.01 0 Z M11 8 V14",
  marks: "M1.8 4 H8 V9.5 H1.8 Z M8 6 10.8 4.5 V9 L8 7.6 M12.5 10 a1.7 1.7 0 1 0 0.01 0 Z M12.5 7.9 V8.5 M12.5 14.6 V15 M9.6 11.7 H9 M16 11.7 H15.4",
  reach: "M2 13.5 6 8 10.5 9.5 13.5 3.5 M12 2.2 a1.8 1.8 0 1 0 3 1 M1.2 12.7 h2 v2 h-2 z",
  pin: "M5.5 2 H10.5 L9.8 7 L12 9.3 H4 L6.2 7 Z M8 9.3 V14.5",
  blend: "M1.5 13 C6 13 5.5 3 8 3 C10.5 3 10 13 14.5 13 M8 6.5 V13",
  shut: "M3 11.5 H13 M4.8 5 8 8.2 11.2 5",
  unshut: "M3 11.5 H13 M4.8 8.2 8 5 11.2 8.2",
  folder: "M2 4 H6 L7.5 5.8 H14 V12.8 H2 Z",
  import: "M8 2 V9.6 M4.8 6.5 8 9.7 11.2 6.5 M2.5 10.5 V13.5 H13.5 V10.5",
  warning: "M8 2 14.5 13.5 H1.5 Z M8 6.5 V9.8 M8 11.6 v0.2",
  error: "M8 1.8 a6.2 6.2 0 1 0 0.01 0 Z M8 4.8 V8.6 M8 10.8 v0.2",
  info: "M8 1.8 a6.2 6.2 0 1 0 0.01 0 Z M8 7.4 V11.2 M8 5 v0.2",
};

const kFilled = new Set(["play", "stop", "next", "before"]);

export function icon(name) {
  return svg("svg", {viewBox: "0 0 16 16", class: kFilled.has(name) ? "glyph filled" : "glyph", "aria-hidden": "true"},
             svg("path", {d: kPaths[name]}));
}

export function setIcon(button, name) {
  button.querySelector("svg.glyph")?.remove();
  button.prepend(icon(name));
}

export function logo() {
  return svg("svg", {viewBox: "0 0 32 32", class: "logo", "aria-hidden": "true"},
             svg("circle", {cx: 16, cy: 16, r: 9}),
             svg("ellipse", {cx: 16, cy: 16, rx: 15, ry: 4.8, transform: "rotate(-24 16 16)"}));
}

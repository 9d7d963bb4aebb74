// Handles over a view's picture, where the studio says that they are (pixels of the picture).

import {svg} from "./dom.js";

const kDot = 3.6, kJoint = 2.6, kSelected = 4.5, kHead = 9, kPin = 6;
const kNearest = 0.4, kFading = 0.72;  // how much the nearest ghost hides, and what is left of that a step further
const kMany = 60;  // points of a shape: more would hide what they shape

// In place of what the layer shows.
export function showHandles(layer, shapes) {
  layer.classList.toggle("dense", shapes.filter(({kind}) => kind === "point").length > kMany);
  layer.replaceChildren(...ghosts(shapes.filter(({kind}) => kind === "ghost")), ...shapes.filter(({kind}) => kind !== "ghost").map(drawn));
}

// The polygons of a figure at one frame are one picture, through which others show: the nearest frames over the rest.
function ghosts(shapes) {
  const figures = new Map();
  for (const {text, points} of shapes) figures.set(text, [...(figures.get(text) ?? []), svg("path", {d: `${pathOf(points)}Z`})]);
  const away = ([text]) => Math.abs(Number(text));
  const ordered = [...figures].sort((one, other) => away(other) - away(one));
  const step = ordered.length ? away(ordered.at(-1)) || 1 : 1;
  return ordered.map(([text, paths]) => svg("g", {class: `handle ghost ${sideOf(text)}`, "data-id": `ghost:${text}`,
                                                  opacity: kNearest * kFading ** (Math.abs(Number(text)) / step - 1)}, paths));
}

const sideOf = (text) => Number(text) < 0 ? "before" : Number(text) > 0 ? "after" : "";

function drawn(shape) {
  const kinds = ["handle", shape.kind];
  if (shape.kind === "trail") kinds.push(sideOf(shape.text));
  if (shape.axis !== undefined && shape.axis !== null) kinds.push(`axis-${axisName(shape.axis)}`);
  if (shape.hot) kinds.push("hot");
  if (shape.selected) kinds.push("selected");
  return svg("g", {class: kinds.filter(Boolean).join(" "), "data-id": shape.id}, (kParts[shape.kind] ?? line)(shape));
}

const axisName = (axis) => typeof axis === "number" ? "xyz"[axis] : axis;

// Lines have a wider one below them, so that they can be seen over any picture.
const line = ({points}) => [svg("path", {class: "halo", d: pathOf(points)}), svg("path", {class: "line", d: pathOf(points)})];
const dots = ({kind, points, selected}) =>
  points.map(([x, y]) => svg("circle", {cx: x, cy: y, r: selected ? kSelected : kind === "joint" ? kJoint : kDot}));
const squares = ({points}) =>
  points.map(([x, y]) => svg("rect", {x: x - kDot, y: y - kDot, width: 2 * kDot, height: 2 * kDot, rx: 1}));

const lineOrDot = (shape) => shape.points.length === 1 ? dots(shape) : line(shape);

const kParts = {
  ring: line,
  limit: line,
  arrow: (shape) => [...line(shape), svg("path", {class: "head", d: headOf(shape.points)})],
  box: (shape) => shape.points.length === 1 ? squares(shape) : line(shape),
  point: dots,
  joint: dots,
  trail: lineOrDot,
  camera: lineOrDot,
  light: lineOrDot,
  pin: ({points: [[x, y]]}) => [svg("path", {class: "head", d: `M${x} ${y}l-${kPin / 2} -${kPin}h${kPin}Z`}),
                                svg("circle", {cx: x, cy: y - 1.6 * kPin, r: kPin * 0.6})],
  label: ({points: [[x, y]], text}) => {
    const label = svg("text", {x: x + kHead, y: y - kDot});
    label.textContent = text;
    return [label];
  },
};

const pathOf = (points) => "M" + points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");

function headOf(points) {
  const [to, from] = [points.at(-1), points.at(-2) ?? points.at(-1)];
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const corner = (turn, reach) => [to[0] + reach * Math.cos(angle + turn), to[1] + reach * Math.sin(angle + turn)];
  return pathOf([corner(0, kHead), corner(2.3, kHead * 0.75), corner(-2.3, kHead * 0.75)]) + "Z";
}

// The handles of selected keys: slopes of splines, the two control points of an ease. Frames and values, no pixels.
//
// {kind: "in", "out", "ease-1" or "ease-2", line, index (of the key), at: {frame, value}, from: {frame, value}}

import {onAxis} from "./curve_data.js";

const kEases = {linear: [0, 0, 1, 1], in: [0.42, 0, 1, 1], out: [0, 0, 0.58, 1], both: [0.42, 0, 0.58, 1]};
const kAside = 1 / 6;   // of the way: where a control point shows that lies on its key
const kThird = 1 / 3;  // of the way to the neighbour: Bezier's control point of Hermite's cubic

const fourOf = (ease) => Array.isArray(ease) ? ease : kEases[ease ?? "linear"];

const holds = (each) => each?.key.ease === "hold";

// As host/content/animator/pose/channel.h: from the key before to the key after, but not over a jump.
function slopeAt(keys, index) {
  const here = keys[index], before = holds(keys[index - 1]) ? here : keys[index - 1] ?? here, after = holds(here) ? here : keys[index + 1] ?? here;
  return before === after ? 0 : (after.value - before.value) / (after.key.frame - before.key.frame);
}

function slopeOf(line, index, side) {
  return onAxis(line.keys[index].key[side], line.axes, line.axis) ?? slopeAt(line.keys, index);
}

export function handlesOf(line, index) {
  const {keys} = line, before = keys[index - 1], here = keys[index], after = keys[index + 1];
  const from = {frame: here.key.frame, value: here.value};
  const made = [];
  if (before?.key.ease === "spline") made.push(slope("in", (before.key.frame - from.frame) * kThird));
  if (after && here.key.ease === "spline") made.push(slope("out", (after.key.frame - from.frame) * kThird));
  if (after && here.key.ease !== "spline" && !holds(here)) made.push(...eases(line, index, from, {frame: after.key.frame, value: after.value}));
  return made;

  function slope(kind, frames) {
    return {kind, line, index, from, at: {frame: from.frame + frames, value: from.value + slopeOf(line, index, kind) * frames}};
  }
}

function eases(line, index, from, to) {
  const [x1, y1, x2, y2] = fourOf(line.keys[index].key.ease);
  const at = (x, y) => ({frame: from.frame + x * (to.frame - from.frame), value: from.value + y * (to.value - from.value)});
  const first = x1 === 0 && y1 === 0 ? at(kAside, kAside) : at(x1, y1);
  const second = x2 === 1 && y2 === 1 ? at(1 - kAside, 1 - kAside) : at(x2, y2);
  return [{kind: "ease-1", line, index, from, at: first}, {kind: "ease-2", line, index, from: to, at: second}];
}

const rounded = (number) => Number(number.toFixed(3));
const nameOf = ({part, axis, several}) => several || "xyz".includes(axis) ? `${part}.${axis}` : part;


// What a pull at a handle to `to` does; `alone`: the other side of the key stays.
export function handleCommands(handle, to, alone) {
  const {kind, line, index} = handle, {key} = line.keys[index];
  if (kind.startsWith("ease")) return [["animate", "time", line.thing, line.part, "--ease", easeTo(handle, to).join(","), "--frame", `${key.frame}`]];
  const slope = rounded((to.value - handle.from.value) / (to.frame - handle.from.frame));
  const sides = alone ? [kind] : handlesOf(line, index).map((each) => each.kind).filter((each) => each === "in" || each === "out");
  return [["animate", "tangent", line.thing, nameOf(line), "--frame", `${key.frame}`, ...sides.flatMap((side) => [`--${side}`, `${slope}`])]];
}

// On which side of the key it stays.
export function within({kind, from}, {frame, value}) {
  if (kind === "in") return {frame: Math.min(frame, from.frame - 0.25), value};
  if (kind === "out") return {frame: Math.max(frame, from.frame + 0.25), value};
  return {frame, value};
}

function easeTo({kind, line, index}, {frame, value}) {
  const {key, value: begin} = line.keys[index], next = line.keys[index + 1];
  const four = [...fourOf(key.ease)], at = kind === "ease-1" ? 0 : 2;
  four[at] = Math.min(1, Math.max(0, rounded((frame - key.frame) / (next.key.frame - key.frame))));
  if (next.value !== begin) four[at + 1] = Math.min(10, Math.max(-10, rounded((value - begin) / (next.value - begin))));
  return four;
}

// Selected keys of a line by frames and value; a run of them is one command.
export function valueCommands(line, picked, by) {
  const word = nameOf(line), command = (text, frames) => ["animate", "pose", line.thing, text, "--frame", frames, "--clamp"];
  const amount = rounded(by);
  if (amount === 0) return [];
  const relative = `${word}${amount < 0 ? "-" : "+"}=${Math.abs(amount)}`;
  return picked.map(({first, last, value}) =>
    first === last ? command(`${word}=${rounded(value + by)}`, `${first}`) : command(relative, `${first}-${last}`));
}

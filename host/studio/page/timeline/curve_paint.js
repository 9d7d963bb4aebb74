// How curves, their keys and handles look. `plot` says where frames and values are: x(frame), y(value).

import {clamped, written} from "../numbers.js";

const kPoint = 4, kHandle = 3.2, kApart = 34;  // pixels
const kAxisColor = {x: "axis-x", y: "axis-y", z: "axis-z"};
const kColors = ["accent", "key-eased", "key-spline", "key-linear"];

export const colorOf = (colors, {axis}, i) => colors[kAxisColor[axis] ?? kColors[i % kColors.length]];

// Where the values may be.
export function drawLimits(pen, {width, colors}, plot, {limits: [lower, upper], axis}) {
  const top = plot.y(upper), bottom = plot.y(lower);
  pen.fillStyle = colors[kAxisColor[axis]] ?? colors.accent;
  pen.globalAlpha = 0.07;
  pen.fillRect(0, top, width, bottom - top);
  pen.globalAlpha = 0.5;
  for (const y of [top, bottom]) pen.fillRect(0, Math.round(y), width, 1);
  pen.globalAlpha = 1;
}

// Values that have a number.
function steps({low, perValue}, height) {
  let step = 1e-3;
  for (let i = 0; step * perValue < kApart; ++i) step *= [2, 2.5, 2][i % 3];
  const first = Math.ceil(low / step), last = Math.floor((low + height / perValue) / step);
  return Array.from({length: Math.max(0, last - first + 1)}, (_, i) => (first + i) * step);
}

export function drawGrid(pen, {width, height, colors}, plot, frames) {
  pen.fillStyle = colors.grid;
  for (const frame of frames) pen.fillRect(Math.round(plot.x(frame)), 0, 1, height);
  for (const value of steps(plot, height)) pen.fillRect(0, Math.round(plot.y(value)), width, 1);
  pen.fillStyle = colors["edge-strong"];
  pen.fillRect(0, Math.round(plot.y(0)), width, 1);
}

export function drawNumbers(pen, {height, colors}, plot) {
  pen.textAlign = "left";
  pen.lineWidth = 3;
  pen.strokeStyle = colors.sheet;
  pen.fillStyle = colors.muted;
  for (const value of steps(plot, height)) {
    const text = written(value, 3), y = plot.y(value) - 7;
    pen.strokeText(text, 5, y);
    pen.fillText(text, 5, y);
  }
}

// As many of its values as pixels can show.
export function drawLine(pen, {width}, plot, {values, first}, color) {
  const {from, perFrame} = plot.axis;
  const begin = clamped(Math.floor(from) - first, 0, values.length), every = Math.max(1, Math.floor(0.5 / perFrame));
  pen.beginPath();
  for (let i = begin; i < values.length; i += every) {
    const x = plot.x(first + i);
    pen.lineTo(x, plot.y(values[i]));
    if (x > width) break;
  }
  pen.strokeStyle = color;
  pen.lineWidth = 1.6;
  pen.lineJoin = "round";
  pen.stroke();
}

export function drawPoint(pen, colors, x, y, picked, color) {
  pen.beginPath();
  pen.arc(x, y, picked ? kPoint + 0.6 : kPoint, 0, 2 * Math.PI);
  pen.fillStyle = picked ? colors.accent : color;
  pen.fill();
  pen.lineWidth = 1.5;
  pen.strokeStyle = picked ? colors.text : colors.sheet;
  pen.stroke();
}

// Those of eases are squares, slopes have circles.
export function drawHandle(pen, colors, plot, {kind, from}, at) {
  const x = plot.x(at.frame), y = plot.y(at.value);
  pen.beginPath();
  pen.moveTo(plot.x(from.frame), plot.y(from.value));
  pen.lineTo(x, y);
  pen.strokeStyle = colors.muted;
  pen.lineWidth = 1;
  pen.stroke();
  pen.beginPath();
  if (kind.startsWith("ease")) pen.rect(x - kHandle, y - kHandle, 2 * kHandle, 2 * kHandle);
  else pen.arc(x, y, kHandle, 0, 2 * Math.PI);
  pen.fillStyle = colors.sheet;
  pen.fill();
  pen.strokeStyle = colors.text;
  pen.lineWidth = 1.5;
  pen.stroke();
}

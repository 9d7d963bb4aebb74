// One colour a node, far from its neighbours': hues by the golden angle.
export const nodeColor = (node, alpha = 1) => `hsl(${(node * 137.508 + 24) % 360} 62% 55% / ${alpha})`;

export const kPhases = [  // of a node's work on a frame, in order
  ["dice", "Dice and transform", "#7c8cff"],
  ["setup", "Edge boxes", "#3fb8a7"],
  ["exchange", "Exchange", "#e0a83f"],
  ["raster", "Scan and shade", "#e07b4f"],
  ["shadow", "Shadows", "#8b6fb0"],
  ["wait", "Wait to send", "#8a919c"],
];
const kOther = "#8a919c";
export const phaseColor = (phase) => kPhases.find(([name]) => name === phase)?.[2] ?? kOther;

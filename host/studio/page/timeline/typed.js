// A film's steps as commands, as a person types them (docs/studio.md, "Files and history").

import {written} from "../numbers.js";

const numbersOf = (value) => [value].flat().map((number) => written(number, 4)).join(",");

// Words that a shell would read otherwise are quoted.
export function typed([program, ...words], film) {
  const quoted = (word) => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
  return ["mars", program, film, ...words].map(quoted).join(" ");
}

// Of a step that was committed at this frame.
export function commandsOf(step, frame) {
  if (step.commands) return step.commands;
  if (step.script) return [["animate", "script", step.script.name, "--lengthen"]];
  const {set, actor, joint, pose, ...others} = step;
  const posed = (thing, values, ...more) => {
    const parts = Object.entries(values).map(([part, value]) => `${part}=${numbersOf(value)}`);
    return [["animate", "pose", thing, ...parts, "--frame", `${frame}`, ...more]];
  };
  if (set === "pose") return posed(actor, {[joint]: pose}, "--clamp");
  if (set === "place" || set === "turn") return posed(actor, {[set]: step[set]});
  return set === "camera" ? posed("camera", others) : [];
}

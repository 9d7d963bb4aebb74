// A film's camera: its keys of the table, and whom it looks at or goes along with.

import {choice, line, part} from "../../fields.js";
import {targetOf} from "./controls.js";
import {keyFields} from "./key_fields.js";

export function cameraPart(controls) {
  const now = () => controls.project.camera;
  if (!now()) return null;
  const words = (name, {keyed}, text) => keyed ? controls.posed("camera", `${name}=${text}`) : ["film", "camera", `${name}=${text}`];
  const [usual, rare] = keyFields(controls, {of: "camera", kind: controls.project.settings.color, now, words});
  return part("Camera", usual, bound(controls, "Look at", "look"), bound(controls, "Go along", "follow"), rare);
}

// `word`: of the command, and of what the project says.
function bound(controls, label, word) {
  const made = choice({name: `Camera: ${label.toLowerCase()} an actor`, options: [[null, "Nobody"], ...controls.targets()], key: `camera.${word}`,
                       commit: (target, event) => controls.commit(["animate", word, target ?? "--end", ...controls.atFrame()], event)});
  controls.whenSet(() => made.set(targetOf(controls.project.camera?.[word])));
  return line(label, made.root);
}

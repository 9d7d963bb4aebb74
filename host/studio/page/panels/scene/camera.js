// A film's camera: its keys of the table, and whom it looks at or goes along with.

import {element} from "../../dom.js";
import {part} from "../../fields.js";
import {keyFields} from "./key_fields.js";

export function cameraPart(controls) {
  const now = () => controls.project.camera;
  if (!now()) return null;
  const words = (name, _, text) => controls.changed("camera", now(), name, text);
  const [usual, rare] = keyFields(controls, {of: "camera", kind: controls.project.settings.color, now, words});
  return part("Camera", usual, bound(controls, "Look at", "look"), bound(controls, "Go along", "follow"),
              element("div", {class: "actions"}, controls.button("Insert key", "camera.key", () => ["animate", "key", "camera", ...controls.atFrame()]), cut(controls)), rare);
}

function cut(controls) {
  const made = controls.button("Cut here", "camera.cut", () => ["animate", "cut", "camera", ...controls.atFrame()]);
  made.title = "From this frame on the camera may be elsewhere at once; what is before stays as it is";
  return made;
}

// `word`: of the command, and of what the project says.
function bound(controls, label, word) {
  return controls.target(label, `Camera: ${label.toLowerCase()} an actor`, `camera.${word}`,
                         (target, event) => controls.commit(["animate", word, target ?? "--end", ...controls.atFrame()], event),
                         () => controls.project.camera?.[word]);
}

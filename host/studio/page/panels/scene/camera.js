// A film's camera: where it is, where it looks, and whom it looks at or goes along with.

import {element} from "../../dom.js";
import {part} from "../../fields.js";
import {rangeOf} from "./controls.js";

export function cameraPart(controls) {
  const now = () => controls.project.camera;
  if (!now()) return null;
  const vector = (label, member) => controls.vector(label, `Camera, ${label.toLowerCase()}`, `camera.${member}`, 0.1,
                                                    (value) => controls.posed("camera", `${member}=${value.join(",")}`), () => now()?.[member]);
  const angle = {name: "Camera, view angle", unit: "°", ...rangeOf(controls.project.keys.camera.fov), step: 1, key: "camera.fov"};
  return part("Camera", vector("Eye", "eye"), vector("Looks at", "at"),
              controls.number("View angle", angle, (fov) => controls.posed("camera", `fov=${fov}`), () => now()?.fov),
              bound(controls, "Look at", "look"), bound(controls, "Go along", "follow"),
              element("div", {class: "actions"}, cut(controls)));
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

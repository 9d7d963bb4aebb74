// A film's camera: where it is, where it looks, and whom it looks at or goes along with.

import {choice, line, part} from "../../fields.js";

const kNobody = "--end";

export function cameraPart(controls) {
  const now = () => controls.project.camera;
  if (!now()) return null;
  const stepOf = (change) => ({set: "camera", eye: now().eye, at: now().at, fov: now().fov, ...change});
  const vector = (label, member) => controls.vector(label, `Camera, ${label.toLowerCase()}`, `camera.${member}`, 0.1,
                                                    (value) => stepOf({[member]: value}), () => now()?.[member]);
  const angle = {name: "Camera, view angle", unit: "°", least: 0.01, most: 179, step: 1, key: "camera.fov"};
  return part("Camera", vector("Eye", "eye"), vector("Looks at", "at"),
              controls.number("View angle", angle, (fov) => stepOf({fov}), () => now()?.fov),
              bound(controls, "Look at", "look"), bound(controls, "Go along", "follow"));
}

function bound(controls, label, word) {
  const options = [[null, "Choose an actor\u2026"], [kNobody, "Nobody from here on"], ...controls.targets()];
  const made = choice({name: `Camera: ${label.toLowerCase()} an actor`, options, key: `camera.${word}`, commit: (target, event) => {
    if (target !== null) controls.commit(["animate", word, target, ...controls.atFrame()], event);
    made.set(null);
  }});
  return line(label, made.root);
}

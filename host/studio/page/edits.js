// What hands do to the project: previews while they move, a commit when they are done.

import {kNoEvent} from "./latencies.js";
import {Unanswered} from "./unanswered.js";
import {jointStep, poseStep, removeJointStep} from "./words.js";

export class Edits {
  constructor(connection, pace, state) {
    this.connection = connection;
    this.pace = pace;
    this.state = state;
  }

  #previews = false;
  wanted = null;          // {actor, joint, more, isShown: views show the whole of it}, to be selected once they are there
  unanswered = new Unanswered();

  preview(step, event) {
    this.#previews = true;
    this.pace.send("preview", {do: "preview", step}, event ?? kNoEvent);
  }

  // At once, in place of one that the studio has ended.
  previewAgain(step) { this.pace.now({do: "preview", step}, kNoEvent); }

  commit(step, event) {
    this.#previews = false;
    this.unanswered.add(step, this.state);
    this.pace.drop("preview");
    this.pace.now({do: "commit", step}, event ?? kNoEvent);
  }

  cancel() {
    if (!this.#previews) return;
    this.#previews = false;
    this.pace.drop("preview");
    this.connection.send({do: "cancel"});
  }

  // Steps of one joint.
  joint(change, joint = this.state.selected.joint) { return jointStep("set", joint, change); }
  pose(pose) {
    const {actor, joint} = this.state.selected;
    return this.state.isFilm() ? poseStep(actor, {[joint]: pose}, this.state.project.frame, this.state.falloff) : {pose: {[joint]: pose}};
  }

  select(actor, joint, more = []) {
    this.state.select(actor, joint, null, more);
    this.connection.send({do: "select", actor, joint, more});
  }

  // The camera or a light.
  selectThing(thing) {
    this.state.select(null, null, thing);
    this.connection.send({do: "select", thing});
  }

  // A joint that stays where it is while others are pulled, or no longer.
  pin() {
    const {actor, joint} = this.state.selected;
    if (joint === null) return;
    const pinned = !this.state.pins.some((pin) => pin.actor === actor && pin.joint === joint);
    this.connection.send({do: "pin", actor, joint, pinned});
  }

  undo() { this.#goTo("undo"); }
  redo() { this.#goTo("redo"); }

  frame(frame, event) { this.pace.send("frame", {do: "frame", frame}, event ?? kNoEvent); }

  removeJoint() {
    const {joint} = this.state.selected;
    if (joint === null) return;
    const parent = this.state.joint()?.parent ?? null;
    this.commit(removeJointStep(joint));
    if (parent) this.select(this.state.selected.actor, parent);
  }

  // Below the selected joint, at the end of its box.
  addJoint() {
    const actor = this.state.actor() ?? this.state.project?.actors[0];
    if (!actor) return;
    const parent = this.state.joint();
    const name = freeName(actor.joints.map((joint) => joint.name));
    const change = parent ? {parent: parent.name, ...placed(parent)} : {};
    this.commit(jointStep("add", name, change));
    this.wanted = {actor: actor.name, joint: name};
  }

  // Beside what is there at the frame that shows. What was there alone may be a large floor, on which one sees little of
  // the actor.
  addActor(name, model, event) {
    const {frame, actors} = this.state.project;
    this.commit({commands: [["film", "add", name, "--model", model, "--beside", `${frame}`]]}, event);
    this.wanted = {actor: name, joint: null, isShown: actors.length <= 1};
  }

  // Returns what was wanted, if it is there now.
  selectWanted() {
    const wanted = this.wanted, found = wanted && (wanted.joint === null ? this.state.actor(wanted.actor) : this.state.joint(wanted.joint, wanted.actor));
    if (!found) return null;
    this.wanted = null;
    this.select(wanted.actor, wanted.joint, wanted.more?.filter((name) => this.state.joint(name, wanted.actor)));
    return wanted;
  }

  #goTo(where) {
    this.unanswered.forget();
    this.connection.send({do: where});
  }
}

function freeName(names) {
  for (let number = 1;; ++number) if (!names.includes(`joint-${number}`)) return `joint-${number}`;
}

// A child's box continues its parent's along the longest side.
function placed({sbb, material}) {
  if (!sbb) return {};
  const [min, max] = sbb;
  const sizes = min.map((low, axis) => max[axis] - low);
  const along = sizes.indexOf(Math.max(...sizes));
  const down = -min[along] > max[along];
  const place = [0, 0, 0];
  place[along] = down ? min[along] : max[along];
  return {place, shape: "ellipsoid", sbb, ...(material ? {material} : {})};
}

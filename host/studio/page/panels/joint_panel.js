// The selected joint: its pose within its limits, its place and axes, its segment, and what may be done with it.

import {element, keepingFocus} from "../dom.js";
import {choice, line, numberField, part, sliderField, textField, toggle, vectorField} from "../fields.js";
import {icon} from "../icons.js";
import {keysOf} from "../shortcuts.js";
import {mirrorStep} from "../words.js";
import {shapeLines} from "./shape_lines.js";

const kAxes = ["x", "y", "z"];
const kWhole = 180;  // degrees: limits of a free axis

const freeOf = (joint) => kAxes.filter((axis) => joint.free.includes(axis));
const limitsOf = (joint, i) => joint.limits?.[i] ?? [-kWhole, kWhole];

export class JointPanel {
  #fields = [];  // {set(joint)}
  #built = "";

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    state.on("project selected", () => this.#update());
    state.on("poses", () => this.#set());
  }

  // The name is edited in its field.
  rename() { this.place.querySelector('[data-key="name"]')?.select(); }

  rest(event) {
    const joint = this.state.joint();
    if (joint?.pose) this.edits.commit(this.edits.pose(atRest(joint)), event);
  }

  #update() {
    const joint = this.state.joint();
    const {project, selected} = this.state;
    const built = !joint ? `${this.#whatIsSelected()} ${this.#firstSteps().flat()}` : JSON.stringify([project.kind, selected, joint.free, joint.limits, joint.shape, Boolean(joint.sbb),
                                           Boolean(joint.pose), project.shapes, Object.keys(joint.options ?? {}),
                                           project.materials.map(({name}) => name),
                                           this.state.actor().joints.map(({name}) => name)]);
    if (built !== this.#built) {
      this.#built = built;
      keepingFocus(this.place, () => this.#build(joint));
    }
    this.#set();
  }

  #set() {
    const joint = this.state.joint();
    if (joint) for (const field of this.#fields) field.set(joint);
  }

  // A field shows what `of` takes from the joint.
  #field(made, of) {
    this.#fields.push({set: (joint) => made.set(of(joint))});
    return made.root;
  }

  #build(joint) {
    this.#fields = [];
    if (!joint) return this.place.replaceChildren(this.#nothing());
    const film = this.state.isFilm();
    this.place.replaceChildren(...[this.#head(film), this.#pose(joint, film), !film && this.#limits(joint), !film && this.#frame(),
                                   !film && this.#segment(joint), !film && this.#actions()].filter(Boolean));
  }

  #nothing() {
    const line = ([key, text]) => element("div", {}, element("dt", {}, element("kbd", {}, key)), element("dd", {}, text));
    return element("div", {class: "nothing"}, element("p", {}, this.#whatIsSelected()),
                   element("dl", {}, this.#firstSteps().map(line)));
  }

  #whatIsSelected() {
    const {actor, thing} = this.state.selected;
    if (!this.state.isFilm()) return "No joint is selected.";
    if (actor !== null) return `${actor} is selected as a whole: its name, place, turn and carrier are in the panel Scene.`;
    if (thing !== null) return `The ${thing.replace("/", " ")} is selected: its numbers are in the panel Scene.`;
    return "No joint of an actor is selected.";
  }

  // What a person may do, by what there is.
  #firstSteps() {
    const actors = this.state.project?.actors ?? [], help = [keysOf("help"), "lists all keys"];
    const film = this.state.isFilm();
    if (film && actors.length === 0) return [["Scene", "adds actors: figures and things"], help];
    if (film || actors.some(({joints}) => joints.some(({shape}) => shape))) return [...kWithLimbs, help];
    return [["Click", "a joint in the tree, to give it a shape: then it is a limb"], [keysOf("addJoint"), "adds a joint"],
            ["Bodies", "begins with a whole figure"], help];
  }

  #head(film) {
    const name = textField({name: "Name of the joint", key: "name", commit: (to, event) => {
      const {actor, joint} = this.state.selected;
      this.edits.wanted = {actor, joint: to};
      this.edits.commit(this.edits.joint({name: to}, joint), event);
    }});
    name.input.title = `Rename (${keysOf("rename")})`;
    name.input.readOnly = film;
    return element("div", {class: "head"}, icon("joint"), this.#field(name, (joint) => joint.name),
                   film && element("span", {class: "of"}, this.state.selected.actor));
  }

  #pose(joint, film) {
    const {edits} = this;
    const sliders = (joint.pose ? freeOf(joint) : []).map((axis) => {
      const i = kAxes.indexOf(axis);
      const [least, most] = limitsOf(joint, i);
      const posed = (angle) => edits.pose(this.state.joint().pose.map((each, at) => at === i ? angle : each));
      return this.#field(sliderField({
        name: `Turn about ${axis}`, letter: axis, unit: "°", least, most, key: `pose.${axis}`,
        preview: (angle, event) => edits.preview(posed(angle), event), commit: (angle, event) => edits.commit(posed(angle), event),
        cancel: () => edits.cancel(),
      }), ({pose}) => pose[i]);
    });
    const rest = element("button", {class: "quiet icon", "aria-label": "Put the joint at rest", title: `At rest (${keysOf("rest")})`,
                                    onclick: (event) => this.rest(event)}, icon("reset"));
    const made = part("Pose", sliders.length ? sliders : element("p", {class: "hint"}, joint.pose ? "This joint cannot turn." : "This actor moves by matrices."));
    if (sliders.length && !film) made.querySelector(".body").append(element("p", {class: "hint"}, "For trying out: not kept in the file, not undone."));
    const summary = made.querySelector("summary");
    if (film) summary.append(this.#keyed());
    if (sliders.length) made.querySelector(".body").prepend(element("div", {class: "corner"}, rest));
    return made;
  }

  #keyed() {
    const mark = element("span", {class: "keyed-state"}, icon("key"), element("span", {}));
    this.#fields.push({set: ({keyed}) => {
      mark.classList.toggle("on", Boolean(keyed));
      mark.lastChild.textContent = keyed ? "Key at this frame" : "Between keys";
    }});
    return mark;
  }

  #limits(joint) {
    const lines = kAxes.map((axis, i) => {
      const free = joint.free.includes(axis);
      const [least, most] = limitsOf(joint, i);
      const all = (change) => Object.fromEntries(kAxes.filter((each) => change[each] !== null && (change[each] || joint.free.includes(each)))
        .map((each) => [each, change[each] ?? limitsOf(this.state.joint(), kAxes.indexOf(each))]));
      const commit = (limit, event) => this.edits.commit(this.edits.joint({freedom: "fixed", limits: all({[axis]: limit})}), event);
      const bound = (which, at) => this.#field(numberField({
        name: `${which} limit about ${axis}`, unit: "°", step: 5, key: `limit.${axis}.${at}`,
        commit: (angle, event) => commit(at === 0 ? [angle, Math.max(angle, most)] : [Math.min(angle, least), angle], event),
      }), (now) => limitsOf(now, i)[at]);
      const turns = this.#field(toggle({name: `Turns about ${axis}`, text: element("span", {class: `axis-${axis}`}, axis), key: `free.${axis}`,
                                        commit: (on, event) => commit(on ? [-kWhole, kWhole] : null, event)}),
                                (now) => now.free.includes(axis));
      return element("div", {class: "limits"}, turns, free ? [bound("Lower", 0), bound("Upper", 1)]
                                                           : element("span", {class: "hint"}, "fixed"));
    });
    return part("Limits", lines);
  }

  #frame() {
    const vector = (label, member, key, otherwise, step) => line(label, this.#field(vectorField({
      name: label, key, step, ...this.#changes((value) => ({[member]: value})),
    }), (joint) => joint[member] ?? otherwise));
    const joints = this.state.actor().joints;
    const below = descendants(joints, this.state.selected.joint);
    const parents = joints.filter(({name}) => !below.has(name)).map(({name}) => [name, name]);
    const parent = choice({name: "Parent", key: "parent", options: [[null, "None"], ...parents],
                           commit: (name, event) => this.edits.commit(this.edits.joint(name ? {parent: name} : {reset: ["parent"]}), event)});
    return part("Place and axes", line("Parent", this.#field(parent, (joint) => joint.parent ?? null)),
                vector("Place", "place", "place", [0, 0, 0], 0.05), vector("X axis", "x_axis", "x_axis", [1, 0, 0], 0.1),
                vector("Y axis", "y_axis", "y_axis", [0, 1, 0], 0.1));
  }

  #segment(joint) {
    const {project} = this.state;
    const names = project.shapes.map(({name}) => name);
    const own = joint.shape && !names.includes(joint.shape) ? [joint.shape] : [];
    const shape = choice({name: "Shape", key: "shape", options: [...(joint.shape ? [] : [[null, "None"]]), ...[...own, ...names].map((name) => [name, label(name)])],
                          commit: (name, event) => this.edits.commit(this.edits.joint(name ? {shape: name} : {reset: ["segment"]}), event)});
    const lines = [line("Shape", this.#field(shape, (now) => now.shape ?? null))];
    if (joint.shape) {
      lines.push(...shapeLines(joint, project.shapes, (made, of) => this.#field(made, of), (of) => this.#changes(of)));
      const corner = (text, i) => line(text, this.#field(vectorField({
        name: `Box, ${text.toLowerCase()}`, key: `sbb.${i}`, step: 0.02,
        ...this.#changes((value) => ({sbb: this.state.joint().sbb.map((each, at) => at === i ? value : each)})),
      }), (now) => now.sbb[i]));
      if (joint.sbb) lines.push(corner("From", 0), corner("To", 1));
    }
    const material = choice({name: "Material", key: "material", options: [[null, "None (grey)"], ...project.materials.map(({name}) => [name, name])],
                             commit: (name, event) => this.edits.commit(this.edits.joint(name ? {material: name} : {reset: ["material"]}), event)});
    const limb = choice({name: "Limb", key: "limb", options: [[null, "None"], ...(project.limbs ?? []).map((name) => [name, label(name)])],
                         commit: (name, event) => this.edits.commit(this.edits.joint(name ? {limb: name} : {reset: ["limb"]}), event)});
    if (joint.shape) lines.push(line("Material", this.#field(material, (now) => now.material ?? null)));
    lines.push(line("Limb", this.#field(limb, (now) => now.limb || null)));
    return part("Segment", lines);
  }

  #changes(changeOf) {
    return {
      preview: (value, event) => this.edits.preview(this.edits.joint(changeOf(value)), event),
      commit: (value, event) => this.edits.commit(this.edits.joint(changeOf(value)), event),
      cancel: () => this.edits.cancel(),
    };
  }

  #actions() {
    const {edits} = this;
    const action = (glyph, text, tip, act) => element("button", {title: tip, onclick: act}, icon(glyph), text);
    const mirror = (side, other) => action("mirror", `${side === "left" ? "Left" : "Right"} to ${other}`, `Put the ${side} limbs on the ${other}`,
      (event) => edits.commit(mirrorStep(side, this.state.selected.joint), event));
    return part("Joint", element("div", {class: "actions"},
      action("add", "Add below", `Add a joint below this one (${keysOf("addJoint")})`, () => edits.addJoint()),
      action("remove", "Remove", `Remove it and those below it (${keysOf("removeJoint")})`, () => edits.removeJoint()),
      mirror("left", "right"), mirror("right", "left")));
  }
}

const kWithLimbs = [["Click", "a limb in a view, or a joint in the tree, to select it"], ["Drag", "a limb or a ring to pose it, empty space to look around"]];

const label = (name) => name.replace(/[_.]/g, " ");
const atRest = (joint) => kAxes.map((_, i) => joint.free.includes(kAxes[i]) ? Math.min(Math.max(0, limitsOf(joint, i)[0]), limitsOf(joint, i)[1]) : joint.pose[i]);

function descendants(joints, of) {
  const below = new Set([of]);
  for (let grown = true; grown;) {
    grown = false;
    for (const {name, parent} of joints) if (below.has(parent) && !below.has(name)) grown = below.add(name);
  }
  return below;
}

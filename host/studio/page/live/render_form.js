// How a rendering is started, watched and stopped, and how far it is.

import {element} from "../dom.js";
import {choice, line, part, textField} from "../fields.js";
import {icon} from "../icons.js";
import {nodeColor} from "./colors.js";

const kBackends = [[null, "Chosen by MARS"], ["mpi", "MPI"], ["threads", "Threads"]];
const kBackgrounds = [[null, "As in the film"], ["alpha", "Left out (alpha)"]];
// What files hold: words of the options format and layers.
const kFiles = [[null, "PNG"], ["png16", "PNG of 16 bits"], ["exr", "EXR"], ["exr all", "EXR with all layers"]];
const kWords = {none: "No rendering", starting: "Starting", running: "Rendering", done: "Done", failed: "Failed", stopped: "Stopped"};
const kFields = [["folder", "Folder", "out"], ["frames", "Frames", "all"], ["every", "Every Nth", "1"], ["video", "Video", "none"], ["crop", "Part", "whole picture"], ["nodes", "Nodes", "as fit"], ["hostfile", "Hostfile", "this machine"]];

export class RenderForm {
  #options = {folder: "out"};

  constructor(place, {connection, state}) {
    Object.assign(this, {connection, state});
    this.start = element("button", {class: "primary", onclick: () => this.#start()}, icon("render"), "Render");
    this.stop = element("button", {disabled: true, onclick: () => connection.send({do: "stop"})}, icon("stop"), "Stop");
    this.watch = element("button", {title: "Show a rendering that another command started into this folder",
                                    onclick: () => connection.send({do: "watch", folder: this.#options.folder})}, icon("folder"), "Watch");
    this.video = element("button", {title: "Render the frames that are missing, and make a video of the folder's frames",
                                    onclick: () => this.#start(this.#options.video ?? `${this.#options.folder ?? "out"}.mp4`)}, icon("play"), "Make video");
    this.bar = element("progress", {max: 1, value: 0, "aria-label": "Frames done"});
    this.words = element("p", {class: "progress-words"});
    this.text = element("p", {class: "hint", "aria-live": "polite"});
    this.nodes = element("ul", {class: "nodes", "aria-label": "Nodes"});
    place.append(part("Job", ...this.#fields(), element("div", {class: "actions three"}, this.start, this.stop, this.watch),
                      element("div", {class: "actions"}, this.video)),
                 part("Progress", this.words, this.bar, this.text), part("Nodes", this.nodes));
    this.show({state: "none"});
  }

  #fields() {
    const texts = kFields.map(([key, text, hint]) => {
      const field = textField({name: text, key: `render.${key}`, hint, commit: (value) => { this.#options[key] = value; }});
      // Empty is a value here: the command's own default.
      field.input.addEventListener("input", () => { this.#options[key] = field.input.value.trim() || undefined; });
      field.set(this.#options[key] ?? "");
      return line(text, field.root);
    });
    const backend = choice({name: "Backend", key: "render.backend", options: kBackends, commit: (value) => { this.#options.backend = value ?? undefined; }});
    const background = choice({name: "Background", key: "render.alpha", options: kBackgrounds, commit: (value) => { this.#options.alpha = value ? true : undefined; }});
    const files = choice({name: "Files", key: "render.files", options: kFiles, commit: (value) => { [this.#options.format, this.#options.layers] = value?.split(" ") ?? []; }});
    return [...texts, line("Files", files.root), line("Background", background.root), line("Backend", backend.root)];
  }

  #start(video) {
    const {nodes, ...rest} = this.#options;
    if (video) rest.video = video;
    this.connection.send({do: "render", options: nodes === undefined ? rest : {...rest, nodes: Number(nodes)}});
  }

  show({state, text = "", done = 0, of = 0, fps = 0, nodes = []}) {
    const runs = state === "starting" || state === "running";
    const there = state === "done" ? of : done;  // also those that were there before
    this.start.disabled = this.video.disabled = runs;
    this.stop.disabled = !runs;
    this.words.replaceChildren(element("strong", {class: state}, kWords[state] ?? state),
                               of ? ` ${there} of ${of} frames` : "", runs && fps ? `, ${fps.toFixed(1)} a second` : "");
    this.bar.max = of || 1;
    this.bar.value = there;
    this.bar.hidden = of === 0;
    this.text.textContent = text;
    this.nodes.replaceChildren(...nodes.map((each, number) => nodeLine(each, number)));
    this.nodes.parentElement.parentElement.hidden = nodes.length === 0;
  }
}

function nodeLine({name, machine, slow}, number) {
  const dot = element("i", {});
  dot.style.background = nodeColor(number);
  return element("li", {}, dot, element("span", {}, name ?? `node ${number}`), element("span", {class: "machine"}, machine),
                 slow && element("span", {class: "slow"}, "slow"));
}

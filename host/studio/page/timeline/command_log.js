// What was done here, and not undone, as commands that a person could type: the last one in the bar, all of this page in
// a list.

import {element} from "../dom.js";
import {icon} from "../icons.js";
import {openPopover} from "../popover.js";
import {PageSteps} from "./page_steps.js";
import {typed} from "./typed.js";

export class CommandLog {
  #steps = new PageSteps();

  constructor({connection, state}) {
    this.last = element("code", {});
    this.root = element("button", {class: "quiet commands", "data-key": "commands", title: "What would be typed",
                                   onclick: () => this.#open()}, icon("prompt"), this.last);
    connection.on("done", ({commands}) => this.#steps.add(commands.map((words) => typed(words, state.project.file))));
    connection.on("sent", ({do: what}) => { if (what === "undo" || what === "redo") this.#steps.ask(what); });
    state.on("project", () => {
      this.#steps.follow(state.project);
      this.#show();
    });
    this.#show();
  }

  #show() {
    const last = this.#steps.lines.at(-1);
    this.last.textContent = last ?? "Commands";
    this.root.setAttribute("aria-label", `Commands: ${last ?? "none yet"}`);
  }

  #open() {
    const texts = this.#steps.lines;
    const lines = texts.map((text) => element("li", {}, element("code", {}, text), copyButton("Copy this command", text)));
    const all = element("header", {}, element("h3", {}, "Commands"),
                        lines.length > 0 && copyButton("Copy all", texts.join("\n"), "Copy all"));
    const root = openPopover(this.root, "Commands", all, element("p", {class: "hint"}, "What you did on this page, as it would be typed."),
                             lines.length ? element("ol", {class: "command-lines", tabindex: 0}, lines) : element("p", {}, "None yet."));
    root.querySelector("ol")?.scrollTo(0, 1e6);
  }
}

function copyButton(name, text, shown) {
  return element("button", {class: shown ? "quiet" : "quiet icon", "aria-label": name, title: name,
                            onclick: () => navigator.clipboard.writeText(text)}, icon("copy"), shown);
}

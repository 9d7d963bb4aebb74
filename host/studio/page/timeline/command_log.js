// What was done here as commands that a person could type: the last one in the bar, all of this page in a list.

import {element} from "../dom.js";
import {icon} from "../icons.js";
import {openPopover} from "../popover.js";
import {typed} from "./typed.js";

const kKept = 100;

export class CommandLog {
  #lines = [];

  constructor({connection, state}) {
    this.state = state;
    this.last = element("code", {});
    this.root = element("button", {class: "quiet commands", "data-key": "commands", title: "What would be typed",
                                   onclick: () => this.#open()}, icon("prompt"), this.last);
    connection.on("done", ({commands}) => this.#add(commands));
    this.#show();
  }

  #add(commands) {
    const film = this.state.project.file;
    this.#lines = [...this.#lines, ...commands.map((words) => typed(words, film))].slice(-kKept);
    this.#show();
  }

  #show() {
    this.last.textContent = this.#lines.at(-1) ?? "Commands";
    this.root.setAttribute("aria-label", `Commands: ${this.#lines.at(-1) ?? "none yet"}`);
  }

  #open() {
    const lines = this.#lines.map((text) => element("li", {}, element("code", {}, text), copyButton("Copy this command", text)));
    const all = element("header", {}, element("h3", {}, "Commands"),
                        lines.length > 0 && copyButton("Copy all", this.#lines.join("\n"), "Copy all"));
    const root = openPopover(this.root, "Commands", all, element("p", {class: "hint"}, "What you did on this page, as it would be typed."),
                             lines.length ? element("ol", {class: "command-lines", tabindex: 0}, lines) : element("p", {}, "None yet."));
    root.querySelector("ol")?.scrollTo(0, 1e6);
  }
}

function copyButton(name, text, shown) {
  return element("button", {class: shown ? "quiet" : "quiet icon", "aria-label": name, title: name,
                            onclick: () => navigator.clipboard.writeText(text)}, icon("copy"), shown);
}

// The sheet of all shortcuts, made from their table.

import {element} from "./dom.js";
import {icon} from "./icons.js";
import {kHands, kShortcuts, shownKeys} from "./shortcuts.js";

export class Help {
  #dialog = null;

  constructor(state) { this.state = state; }

  toggle() {
    if (this.#dialog?.open) return this.#dialog.close();
    this.#dialog?.remove();
    this.#dialog = this.#makeDialog();
    document.body.append(this.#dialog);
    this.#dialog.showModal();
  }

  #makeDialog() {
    const close = element("button", {class: "quiet icon", "aria-label": "Close", onclick: () => this.#dialog.close()}, icon("close"));
    const dialog = element("dialog", {class: "help", "aria-labelledby": "help-title"},
                           element("header", {}, element("h2", {id: "help-title"}, "Keys and mouse"), close),
                           element("div", {class: "groups"}, groups(this.state.isFilm())));
    dialog.addEventListener("click", ({target}) => { if (target === dialog) dialog.close(); });
    dialog.addEventListener("keydown", (event) => {
      if (event.key !== "?" && event.key !== "F1") return;
      event.preventDefault();
      dialog.close();
    });
    return dialog;
  }
}

function groups(film) {
  const all = [...kShortcuts, ...kHands].filter((each) => !each.film || film);
  return [...new Set(all.map(({group}) => group))].map((group) => element("section", {},
    element("h3", {}, group),
    element("dl", {}, all.filter((each) => each.group === group).map(line))));
}

function line({keys, text}) {
  return element("div", {}, element("dt", {}, keys.map((each) => element("kbd", {}, shownKeys(each)))), element("dd", {}, text));
}

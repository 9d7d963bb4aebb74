// Panels of which one shows (ARIA's tabs pattern).

import {element, newId} from "./dom.js";

export class Tabs {
  // `list`: {name, text}. A panel's element is `panel(name)`; `chosen(name)` hears which one shows.
  constructor(place, list, label = "Panels", chosen = () => {}) {
    this.chosen = chosen;
    this.tabs = list.map(({name, text}) => {
      const panel = element("div", {class: "panel", role: "tabpanel", id: newId("panel")});
      const tab = element("button", {role: "tab", id: newId("tab"), "aria-controls": panel.id, onclick: () => this.show(name)}, text);
      panel.setAttribute("aria-labelledby", tab.id);
      return {name, tab, panel};
    });
    const bar = element("div", {class: "tabs", role: "tablist", "aria-label": label}, this.tabs.map(({tab}) => tab));
    bar.addEventListener("keydown", (event) => this.#key(event));
    this.bar = bar;
    place.append(bar, ...this.tabs.map(({panel}) => panel));
    this.show(list[0].name);
  }

  panel(name) { return this.tabs.find((each) => each.name === name).panel; }
  rename(name, text) { this.tabs.find((each) => each.name === name).tab.textContent = text; }
  available(name, on) { this.tabs.find((each) => each.name === name).tab.hidden = !on; }

  show(name) {
    this.shown = name;
    for (const {name: each, tab, panel} of this.tabs) {
      tab.setAttribute("aria-selected", String(each === name));
      tab.tabIndex = each === name ? 0 : -1;
      panel.hidden = each !== name;
    }
    this.chosen(name);
  }

  #key(event) {
    const by = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const open = this.tabs.filter(({tab}) => !tab.hidden);
    const at = open.findIndex(({name}) => name === this.shown);
    const next = open[(at + by + open.length) % open.length];
    this.show(next.name);
    next.tab.focus();
  }
}

// Light or dark: the system's, unless the switch says otherwise.

import {setIcon} from "./icons.js";
import {ofBrowser} from "./stores.js";

const kSystem = matchMedia("(prefers-color-scheme: light)");

export function currentTheme() { return ofBrowser.get("theme") ?? (kSystem.matches ? "light" : "dark"); }

export class Theme {
  constructor(button) {
    this.button = button;
    kSystem.addEventListener("change", () => this.#show());
    this.#show();
  }

  toggle() {
    ofBrowser.set("theme", currentTheme() === "dark" ? "light" : "dark");
    this.#show();
  }

  #show() {
    const theme = currentTheme();
    document.documentElement.dataset.theme = theme;
    setIcon(this.button, theme === "dark" ? "sun" : "moon");
    const other = theme === "dark" ? "Light theme" : "Dark theme";
    this.button.setAttribute("aria-label", other);
    this.button.title = other;
  }
}

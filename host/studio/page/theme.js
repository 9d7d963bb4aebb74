// Light or dark: the system's, unless the switch says otherwise.

import {setIcon} from "./icons.js";

const kSystem = matchMedia("(prefers-color-scheme: light)");

export function currentTheme() { return localStorage.getItem("theme") ?? (kSystem.matches ? "light" : "dark"); }

export class Theme {
  constructor(button) {
    this.button = button;
    kSystem.addEventListener("change", () => this.#show());
    this.#show();
  }

  toggle() {
    localStorage.setItem("theme", currentTheme() === "dark" ? "light" : "dark");
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

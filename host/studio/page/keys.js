// Acts on shortcuts.js.

import {kShortcuts} from "./shortcuts.js";

// As the table writes it: "Ctrl+Shift+Z", "+", "?".
export function pressed({key, ctrlKey, metaKey, altKey, shiftKey}) {
  const letter = key.length === 1 && key.toLowerCase() !== key.toUpperCase();
  const plain = key === " " ? "Space" : letter ? key.toUpperCase() : key;
  // A sign such as ? is what shift made of its key.
  const shift = shiftKey && (letter || key.length > 1);
  return [(ctrlKey || metaKey) && "Ctrl", altKey && "Alt", shift && "Shift", plain === "=" ? "+" : plain].filter(Boolean).join("+");
}

const kOwnKeys = new Set(["Space", "Enter", "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"]);

// Keys that no control hears are those of the active view.
function where(target, state) {
  if (target.closest("dialog, .menu, .popover")) return {shut: true};
  const text = target.matches("input:not([type=range], [type=checkbox], [type=color]), textarea");
  return {
    text,
    view: target.closest(".view .picture") !== null || (target === document.body && state.workspace === "scene"),
    timeline: target.closest("#timeline") !== null,
    list: target.closest("select") !== null,
    control: target.matches("button, input, select, a[href], [role=tab]"),
  };
}

function holds(shortcut, keys, place) {
  if (place.shut || !shortcut.name) return false;
  if (shortcut.at === "always") return true;
  if (place.text) return false;
  if (shortcut.at === "view") return place.view;
  if (shortcut.at === "timeline") return place.timeline;
  if (shortcut.at !== "page") return false;
  if (place.list && /^[A-Z0-9]$/.test(keys)) return false;
  return !(place.control && kOwnKeys.has(keys));
}

export class Keys {
  // Commands by the table's names; they get the keys and the event, and may return false: not mine.
  constructor(commands, state) {
    addEventListener("keydown", (event) => {
      if (event.defaultPrevented) return;
      const keys = pressed(event);
      const place = where(event.target, state);
      const held = kShortcuts.filter((each) => each.keys.includes(keys) && holds(each, keys, place) &&
                                                 (!each.film || state.isFilm()));
      const shortcut = held.find(({at}) => at === "timeline") ?? held[0];
      if (!shortcut || commands[shortcut.name](keys, event) === false) return;
      event.preventDefault();
    });
  }
}

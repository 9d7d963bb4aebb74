// Models as cards: a picture and a name each, in a grid through which the arrows lead.

import {element} from "../../dom.js";

const kWays = {ArrowRight: 1, ArrowLeft: -1, ArrowDown: 0, ArrowUp: 0};

// `choose(name, event)` is done by a click, Enter or the space bar. `chosen`: the name of the one that is, or null: none
// is yet; missing where cards are no choice but act.
export function modelCards(models, {list, label, choose, chosen}) {
  const cards = list.map(({name, what}) => element("button", {
    class: "card", title: what || name, "data-key": `model.${name}`, "aria-pressed": chosen === undefined ? null : String(chosen === name), tabindex: -1,
    onclick: (event) => choose(name, event)}, models.picture(name), element("span", {class: "name", "aria-hidden": "true"}, shownName(name))));
  (cards.find((card) => card.ariaPressed === "true") ?? cards[0])?.setAttribute("tabindex", 0);
  const root = element("div", {class: "cards", role: "group", "aria-label": label}, cards);
  root.addEventListener("keydown", (event) => move(cards, event));
  root.addEventListener("focusin", ({target}) => { for (const card of cards) card.tabIndex = card === target ? 0 : -1; });
  return {root, set(name) { for (const [i, card] of cards.entries()) card.ariaPressed = String(list[i].name === name); }};
}

const shownName = (name) => name.replace(/\.json$/, "");

function move(cards, event) {
  if (kWays[event.key] === undefined) return;
  event.preventDefault();
  const row = cards.filter((card) => card.offsetTop === cards[0].offsetTop).length;
  const by = kWays[event.key] || (event.key === "ArrowDown" ? row : -row);
  cards[cards.indexOf(document.activeElement) + by]?.focus();
}

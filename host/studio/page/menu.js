// A menu that a button opens: choices, switches and commands, by mouse and by keyboard (the pattern of ARIA's menu
// button).

import {element} from "./dom.js";
import {icon} from "./icons.js";

// Items: {text, keys, act}, with `chosen` (one of a group) or `checked` (a switch) where they have a state;
// {heading}: the next group's.
const kGap = 4;
let open = null;

export function closeMenu() { open?.close(); }

// `items` are asked for when the menu opens.
export function addMenu(button, items) {
  button.setAttribute("aria-haspopup", "menu");
  button.setAttribute("aria-expanded", "false");
  button.addEventListener("click", () => open?.button === button ? closeMenu() : show(button, items()));
  button.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" || open?.button === button) return;
    event.preventDefault();
    event.stopPropagation();
    show(button, items());
  });
}

function show(button, items) {
  closeMenu();
  const root = element("div", {class: "menu", role: "menu", "aria-label": button.getAttribute("aria-label") ?? button.textContent});
  for (const item of items) root.append(item.heading ? heading(item) : entry(item));
  document.body.append(root);
  besides(root, button);
  button.setAttribute("aria-expanded", "true");
  open = {button, close: () => close(root, button)};
  root.addEventListener("keydown", (event) => keyPressed(event, root, button));
  root.addEventListener("focusout", ({relatedTarget}) => { if (relatedTarget !== button && !root.contains(relatedTarget)) closeMenu(); });
  (root.querySelector('[aria-checked="true"]') ?? root.querySelector("button")).focus();
}

const heading = ({heading: text}) => element("div", {class: "heading", role: "presentation"}, text);

function entry({text, keys, act, chosen, checked, disabled}) {
  const state = chosen ?? checked;
  const role = chosen !== undefined ? "menuitemradio" : checked !== undefined ? "menuitemcheckbox" : "menuitem";
  return element("button", {role, tabindex: -1, disabled, "aria-checked": state === undefined ? null : String(state),
                            onclick: (event) => { closeMenu(); act(event); }},
                 element("span", {class: "mark"}, state && icon("check")), element("span", {class: "text"}, text),
                 keys && element("kbd", {}, keys));
}

// Below the button, or above it, or else beside it: never over it.
export function besides(root, button) {
  const at = button.getBoundingClientRect();
  const {offsetWidth: width, offsetHeight: height} = root;
  const below = at.bottom + kGap, above = at.top - kGap - height;
  const beside = below + height > innerHeight && above < 0;
  const left = beside ? at.right + kGap : at.left;
  root.style.left = `${Math.min(left, innerWidth - width - kGap)}px`;
  root.style.top = `${beside ? Math.max(kGap, innerHeight - height - kGap) : below + height > innerHeight ? above : below}px`;
}

function close(root, button) {
  open = null;
  button.setAttribute("aria-expanded", "false");
  const had = root.contains(document.activeElement);
  root.remove();
  if (had) button.focus({preventScroll: true});
}

function keyPressed(event, root) {
  const entries = [...root.querySelectorAll("button:not(:disabled)")];
  const at = entries.indexOf(document.activeElement);
  const go = {ArrowDown: at + 1, ArrowUp: at - 1 + entries.length, Home: 0, End: entries.length - 1}[event.key];
  event.stopPropagation();
  if (go !== undefined) entries[go % entries.length].focus();
  else if (event.key === "Escape" || event.key === "Tab") closeMenu();
  else if (/^\S$/.test(event.key)) entries.find((each) => each.textContent.toLowerCase().startsWith(event.key.toLowerCase()))?.focus();
  else return;
  event.preventDefault();
}

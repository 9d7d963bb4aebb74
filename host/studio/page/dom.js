// Elements in one call: element("button", {class: "icon", onclick: act}, child, "text"). Attributes that are null,
// undefined or false are left out; "on..." are listeners.

const kSvg = "http://www.w3.org/2000/svg";

export function element(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

export function svg(name, attributes = {}, ...children) {
  return fill(document.createElementNS(kSvg, name), attributes, children);
}

function fill(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.flat(Infinity).filter((child) => child !== undefined && child !== null && child !== false));
  return made;
}

let made = 0;
export const newId = (of) => `${of}-${++made}`;

// Lets what follows be done with the focus where it was, where the elements are made again: they are known by their
// `data-key`.
export function keepingFocus(root, rebuild) {
  const key = root.contains(document.activeElement) ? document.activeElement.dataset.key : undefined;
  rebuild();
  if (key) root.querySelector(`[data-key="${CSS.escape(key)}"]`)?.focus({preventScroll: true});
}

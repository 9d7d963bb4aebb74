// Numbers as people read and write them.

// At most `digits` digits behind the point, without zeros at the end.
export function written(number, digits = 4) {
  const text = Number(number).toFixed(digits);
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return short === "-0" ? "0" : short;
}

// Null where it is no number. A comma is a point.
export function read(text) {
  const plain = text.trim().replace(",", ".").replace("\u2212", "-");
  if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain)) return null;
  return Number(plain);
}

export const clamped = (number, least = -Infinity, most = Infinity) => Math.min(most, Math.max(least, number));

const kHex = (share) => Math.round(clamped(share, 0, 1) * 255).toString(16).padStart(2, "0");

// Colours are lists of three numbers from 0 to 1.
export const hexOf = (color) => "#" + color.map(kHex).join("");
export const colorOf = (hex) => [1, 3, 5].map((at) => Number((parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(3)));

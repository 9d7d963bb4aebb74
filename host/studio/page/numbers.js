// Numbers as people read and write them.

// At most `digits` digits behind the point, without zeros at the end.
export function written(number, digits = 4) {
  const text = Number(number).toFixed(digits);
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return short === "-0" ? "0" : short;
}

// The value of a number, or of an expression of numbers with + - * / and parentheses; null where it is neither. A comma is
// a point. +=, -=, *= and /= at the beginning change the number that was there `before`.
export function read(text, before = null) {
  const [, change, rest] = /^\s*(?:([-+*/])=)?(.*)$/s.exec(text.replaceAll(",", ".").replaceAll("\u2212", "-"));
  if (!change) return valueOf(rest);
  return before === null || valueOf(rest) === null ? null : valueOf(`(${before})${change}(${rest})`);
}

// Twelve digits: 0.1 + 0.2 is 0.3.
function valueOf(expression) {
  const tokens = expression.match(/(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|\S/gi) ?? [];
  const value = sum(tokens);
  return tokens.length === 0 && Number.isFinite(value) ? Number(value.toPrecision(12)) : null;
}

// These take what they read from the front of the tokens; what is no number there is NaN.

function sum(tokens) {
  let value = product(tokens);
  while ("+-".includes(tokens[0] ?? "end")) value += tokens.shift() === "+" ? product(tokens) : -product(tokens);
  return value;
}

function product(tokens) {
  let value = factor(tokens);
  while ("*/".includes(tokens[0] ?? "end")) value = tokens.shift() === "*" ? value * factor(tokens) : value / factor(tokens);
  return value;
}

function factor(tokens) {
  const token = tokens.shift();
  if (token === "-") return -factor(tokens);
  if (token === "+") return factor(tokens);
  if (token !== "(") return Number(token);
  const value = sum(tokens);
  return tokens.shift() === ")" ? value : NaN;
}

export const clamped = (number, least = -Infinity, most = Infinity) => Math.min(most, Math.max(least, number));

const kHex = (share) => Math.round(clamped(share, 0, 1) * 255).toString(16).padStart(2, "0");

// Colours are lists of three numbers from 0 to 1.
export const hexOf = (color) => "#" + color.map(kHex).join("");
export const colorOf = (hex) => [1, 3, 5].map((at) => Number((parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(3)));

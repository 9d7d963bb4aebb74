// What a mouse does in the sheet: selects keys, drags them in time, with Alt copies of them; draws a box.

import {copied, moved} from "./key_commands.js";
import {kRow} from "./row_list.js";
import {onDrag} from "./pointer_drag.js";

export class SheetHand {
  constructor(sheet, {keys, axis, rowList, acts, choose}) {
    Object.assign(this, {sheet, keys, axis, rowList, acts, choose});
    onDrag(sheet.root, (event) => this.#begin(event));
    sheet.root.addEventListener("pointermove", (event) => this.#hover(event));
    sheet.root.addEventListener("wheel", (event) => this.#wheel(event), {passive: false});
  }

  #begin(event) {
    this.sheet.root.focus({preventScroll: true});
    if (event.button === 1) return panning(this.axis, (dy) => this.rowList.scrollBy(-dy));
    if (event.button !== 0) return null;
    this.keys.presumeTaken();
    const {row, mark} = this.sheet.find(this.sheet.view.spot(event));
    return mark ? this.#keys(event, row, mark) : this.#box(event);
  }

  #keys(event, row, mark) {
    const picked = mark.keys.every(({thing, part, frame}) => this.keys.isPicked(thing, part, frame));
    const several = event.shiftKey || event.ctrlKey || event.metaKey;
    if (several) this.keys.pick(mark.keys, "flip");
    else if (!picked) this.keys.pick(mark.keys);
    const earliest = Math.min(...this.keys.picked().map(({key}) => key.frame));
    return {
      move: (now, dx) => this.#drag(Math.max(-earliest, Math.round(dx / this.axis.perFrame)), now),
      end: (up, went) => went ? this.#drop(up) : !several && this.#clicked(row, mark),
      giveUp: () => this.#letGo(),
    };
  }

  #clicked(row, mark) {
    this.keys.pick(mark.keys);
    if (row.thing !== null) this.choose(row, "only", false);
  }

  #commands() { return (this.sheet.copies ? copied : moved)(this.keys.chosen(), this.sheet.by); }

  #drag(by, event) {
    if (by === this.sheet.by && event.altKey === this.sheet.copies) return;
    Object.assign(this.sheet, {by, copies: event.altKey});
    this.sheet.redraw();
    this.acts.tryOut(by === 0 ? [] : this.#commands(), event);
  }

  #drop(event) {
    const {by} = this.sheet;
    if (by === 0) return this.#letGo();
    this.acts.commit(this.#commands(), event);
    this.keys.whenAnswered((taken) => {
      this.#still();
      if (taken) this.keys.moved(by);
    });
  }

  #letGo() {
    this.#still();
    this.acts.cancel();
  }

  #still() {
    Object.assign(this.sheet, {by: 0, copies: false});
    this.sheet.redraw();
  }

  #box(event) {
    const {x, y} = this.sheet.view.spot(event);
    const top = this.rowList.top, adds = event.shiftKey || event.ctrlKey || event.metaKey;
    const close = () => { this.sheet.box = null; this.sheet.redraw(); };
    return {
      move: (now) => {
        const to = this.sheet.view.spot(now);
        this.sheet.box = {x, y: y + top - this.rowList.top, toX: to.x, toY: to.y};
        this.#scrollAt(to.y);
        this.sheet.redraw();
      },
      end: (_, went) => {
        if (went) this.keys.pick(this.sheet.keysIn(this.sheet.box), adds ? "add" : "only");
        else if (!adds) this.keys.pick([]);
        close();
      },
      giveUp: close,
    };
  }

  #scrollAt(y) {
    if (y < 0) this.rowList.scrollBy(-kRow);
    else if (y > this.sheet.view.height) this.rowList.scrollBy(kRow);
  }

  #hover(event) {
    if (event.buttons !== 0) return;
    const {mark} = this.sheet.find(this.sheet.view.spot(event));
    this.sheet.root.style.cursor = mark ? "pointer" : "";
    this.sheet.root.title = mark ? `Frame ${mark.frame}: ${[...new Set(mark.keys.map(({part}) => part))].slice(0, 12).join(", ")}, ${mark.look}` : "";
  }

  #wheel(event) {
    event.preventDefault();
    if (zoomedOrPanned(event, this.axis, this.sheet.view)) return;
    this.rowList.scrollBy(event.deltaY);
  }
}

// The middle button's way moves what shows.
export function panning(axis, down) {
  let before = [0, 0];
  return {move: (_, dx, dy) => {
    axis.pan(dx - before[0]);
    down(dy - before[1]);
    before = [dx, dy];
  }};
}

// With Ctrl a wheel zooms in time, with Shift or sideways it pans.
export function zoomedOrPanned(event, axis, view) {
  const sideways = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
  if (event.ctrlKey) axis.zoom(view.spot(event).x, Math.exp(-event.deltaY * 0.002));
  else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) axis.pan(-sideways);
  else return false;
  return true;
}

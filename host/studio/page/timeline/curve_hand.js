// What a mouse does in the curves: selects keys, drags them in time and value, pulls handles.

import {handleCommands, valueCommands, within} from "./curve_handles.js";
import {moved} from "./key_commands.js";
import {onDrag} from "./pointer_drag.js";
import {panning, zoomedOrPanned} from "./sheet_hand.js";

const kNone = {frames: 0, value: 0, line: null};

export class CurveHand {
  constructor(plot, {keys, axis, acts}) {
    Object.assign(this, {plot, keys, axis, acts});
    onDrag(plot.root, (event) => this.#begin(event));
    plot.root.addEventListener("pointermove", (event) => this.#hover(event));
    plot.root.addEventListener("wheel", (event) => this.#wheel(event), {passive: false});
  }

  #begin(event) {
    this.plot.root.focus({preventScroll: true});
    if (event.button === 1) return panning(this.axis, (dy) => this.plot.panValues(dy));
    if (event.button !== 0) return null;
    this.keys.presumeTaken();
    const {handle, line, index} = this.plot.find(this.plot.view.spot(event));
    return handle ? this.#handle(handle) : line ? this.#point(event, line, line.keys[index]) : this.#box(event);
  }

  #handle(handle) {
    const still = () => { this.plot.held = null; this.plot.redraw(); };
    let commands = [];
    return {
      move: (event) => {
        const {x, y} = this.plot.view.spot(event);
        const at = within(handle, {frame: this.axis.frameAt(x), value: this.plot.valueAt(y)});
        this.plot.held = {handle, at};
        commands = handleCommands(handle, at, event.altKey);
        this.plot.redraw();
        this.acts.tryOut(commands, event);
      },
      end: (event) => {
        this.acts.commit(commands, event);
        this.keys.whenAnswered(still);
      },
      giveUp: () => { still(); this.acts.cancel(); },
    };
  }

  #point(event, line, point) {
    const key = {thing: line.thing, part: line.part, frame: point.key.frame};
    const several = event.shiftKey || event.ctrlKey || event.metaKey, picked = this.plot.isPicked(line, point);
    if (several && !picked) this.keys.pick([key], "add");
    else if (!picked) this.keys.pick([key]);
    const earliest = Math.min(...this.keys.picked().map((each) => each.key.frame));
    return {
      move: (now, dx, dy) => this.#drag(line, point, earliest, now, dx, dy),
      end: (up, went) => {
        if (went) return this.#drop(line, up);
        this.keys.pick([key], several && picked ? "flip" : several ? "add" : "only");
      },
      giveUp: () => { this.#hold(kNone); this.acts.cancel(); },
    };
  }

  // With Shift in one direction only, the longer one's.
  #drag(line, point, earliest, event, dx, dy) {
    const across = event.shiftKey && Math.abs(dx) < Math.abs(dy), along = event.shiftKey && !across;
    const frames = across ? 0 : Math.max(-earliest, Math.round(dx / this.axis.perFrame));
    this.#hold({frames, value: along ? 0 : this.#limited(line, point.value, -dy / this.plot.perValue), line});
    this.acts.tryOut(this.#commands(line), event);
  }

  #limited({limits}, value, by) {
    if (!limits) return by;
    return Math.min(limits[1], Math.max(limits[0], value + by)) - value;
  }

  // Values first, where the keys still are; then their frames.
  #commands(line) {
    const {frames, value} = this.plot.by;
    return [...valueCommands(line, this.#runs(line), value), ...(frames === 0 ? [] : moved(this.keys.chosen(), frames))];
  }

  // Selected keys side by side: [{first, last, value of the first}].
  #runs(line) {
    const runs = [];
    let open = false;
    for (const point of line.keys) {
      const picked = this.plot.isPicked(line, point);
      if (picked && open) runs.at(-1).last = point.key.frame;
      else if (picked) runs.push({first: point.key.frame, last: point.key.frame, value: point.value});
      open = picked;
    }
    return runs;
  }

  #drop(line, event) {
    const {frames} = this.plot.by, commands = this.#commands(line);
    this.acts.commit(commands, event);
    this.keys.whenAnswered((taken) => {
      this.#hold(kNone);
      if (taken) this.keys.moved(frames);
    });
  }

  #hold(by) {
    this.plot.by = by;
    this.plot.redraw();
  }

  #box(event) {
    const {x, y} = this.plot.view.spot(event), adds = event.shiftKey || event.ctrlKey || event.metaKey;
    const close = () => { this.plot.box = null; this.plot.redraw(); };
    return {
      move: (now) => {
        const to = this.plot.view.spot(now);
        this.plot.box = {x, y, toX: to.x, toY: to.y};
        this.plot.redraw();
      },
      end: (_, went) => {
        if (went) this.keys.pick(this.#inBox(this.plot.box), adds ? "add" : "only");
        else if (!adds) this.keys.pick([]);
        close();
      },
      giveUp: close,
    };
  }

  #inBox({x, y, toX, toY}) {
    const between = (at, one, other) => at >= Math.min(one, other) && at <= Math.max(one, other);
    return this.plot.lines.flatMap(({thing, part, keys}) => keys
      .filter(({key, value}) => between(this.axis.x(key.frame), x, toX) && between(this.plot.y(value), y, toY))
      .map(({key}) => ({thing, part, frame: key.frame})));
  }

  #hover(event) {
    if (event.buttons !== 0) return;
    const {handle, line} = this.plot.find(this.plot.view.spot(event));
    this.plot.root.style.cursor = handle || line ? "pointer" : "";
    this.plot.root.title = line ? `${line.part} ${line.axis}` : "";
  }

  #wheel(event) {
    event.preventDefault();
    if (zoomedOrPanned(event, this.axis, this.plot.view)) return;
    const {x, y} = this.plot.view.spot(event), factor = Math.exp(-event.deltaY * 0.002);
    this.plot.zoomValues(y, factor);
    this.axis.zoom(x, factor);
  }
}

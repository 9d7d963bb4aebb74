// From an event to the paint of the picture that shows what it did. `window.marsLatencies` keeps what was measured,
// for benches.

const kKept = 20000, kShown = 200, kUnderWay = 1000;

// For messages that want a number though no event caused them: they are not measured.
export const kNoEvent = {timeStamp: null};

export class Latencies {
  #edit = 0;
  #began = new Map();    // edit -> time of its event
  #counted = new Map();  // view -> last edit that was measured
  #painted = [];         // the last second's pictures: {time, view}

  constructor() { window.marsLatencies = []; }

  // A number for a message that an event caused at that time.
  begin(time) {
    ++this.#edit;
    if (time !== null) this.#began.set(this.#edit, time);
    if (this.#began.size > kUnderWay) this.#began.delete(this.#began.keys().next().value);
    return this.#edit;
  }

  painted(view, edit, now) {
    this.#painted.push({time: now, view});
    const began = this.#began.get(edit);
    if (began === undefined || edit <= (this.#counted.get(view) ?? 0)) return;
    this.#counted.set(view, edit);
    window.marsLatencies.push({edit, view, ms: now - began});
    if (window.marsLatencies.length > kKept) window.marsLatencies.splice(0, kKept / 2);
  }

  // Pictures in the last second.
  rate(now) {
    this.#painted = this.#painted.filter(({time}) => time > now - 1000);
    return this.#painted.length;
  }

  rateOf(wanted, now) { return this.#painted.filter(({time, view}) => view === wanted && time > now - 1000).length; }

  // Of the last ones, in ms; null where there are none.
  percentile95() {
    const last = window.marsLatencies.slice(-kShown).map(({ms}) => ms).sort((a, b) => a - b);
    return last.length ? last[Math.ceil(last.length * 0.95) - 1] : null;
  }
}

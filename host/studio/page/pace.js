// Messages of which only the newest counts, such as those of a moving mouse: at most one a channel and animation frame,
// none while the socket has not taken those before. Nothing queues.

export class Pace {
  #waiting = new Map();  // channel -> message
  #sent = new Set();     // channels that had their message in this animation frame
  #asked = false;

  constructor(connection, latencies) {
    this.connection = connection;
    this.latencies = latencies;
  }

  // `join` makes one message of the waiting one and this one. The event gives the message its edit number.
  send(channel, message, event, join) {
    const before = this.#waiting.get(channel);
    const joined = before && join ? join(before.message, message) : message;
    this.#waiting.set(channel, {message: joined, event});
    if (!this.#sent.has(channel)) this.flush(channel);
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => this.#nextFrame());
  }

  // What waits leaves now if there is room; before a message that ends a gesture in any case.
  flush(channel, atOnce = false) {
    const waiting = this.#waiting.get(channel);
    if (!waiting || !(atOnce || this.connection.hasRoom())) return;
    this.#waiting.delete(channel);
    this.#sent.add(channel);
    this.now(waiting.message, waiting.event);
  }

  drop(channel) { this.#waiting.delete(channel); }

  // Sends it with an edit number if it is the work of an event.
  now(message, event) {
    this.connection.send(event ? {...message, edit: this.latencies.begin(event.timeStamp)} : message);
  }

  #nextFrame() {
    this.#asked = false;
    this.#sent.clear();
    for (const channel of [...this.#waiting.keys()]) this.flush(channel);
    if (this.#waiting.size === 0) return;
    this.#asked = true;
    requestAnimationFrame(() => this.#nextFrame());
  }
}

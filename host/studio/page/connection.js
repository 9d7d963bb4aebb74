// The page's WebSocket (docs/studio-protocol.md). It connects again by itself, with growing pauses; what listens to
// "connected" asks for all that it needs again. A browser does not say why a WebSocket is refused: a plain request does.

import {ofTab} from "./stores.js";

const kFirstPause = 250, kLongestPause = 4000;  // ms

// The link's token stays with this tab and leaves the address, which people copy.
function takeToken() {
  const address = new URL(location.href);
  const given = address.searchParams.get("token");
  if (given !== null) {
    ofTab.set("token", given);
    address.searchParams.delete("token");
    history.replaceState(null, "", address);
  }
  return given ?? ofTab.get("token") ?? "";
}

export class Connection {
  #listeners = new Map();
  #socket = null;
  #pause = kFirstPause;
  #token = takeToken();

  // `is`: of messages; "picture" (an ArrayBuffer), "connected", "gone" (the number of attempts that failed; whether a
  // studio is there for which the page's token is wrong), "sent" (a message of this page that has left).
  on(is, listener) {
    if (!this.#listeners.has(is)) this.#listeners.set(is, []);
    this.#listeners.get(is).push(listener);
  }

  failures = 0;

  // The address of a request of this page to the studio.
  addressOf(path) { return this.#address(path); }

  open() {
    const address = this.#address();
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.#opened();
    socket.onmessage = ({data}) => this.#take(data);
    socket.onclose = () => this.#closed();
    this.#socket = socket;
  }

  // Whether the message left.
  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(message));
    this.#tell("sent", message);
    return true;
  }

  // Whether all that was sent has left this machine's buffers.
  hasRoom() { return this.#socket?.readyState === WebSocket.OPEN && this.#socket.bufferedAmount === 0; }

  #opened() {
    this.failures = 0;
    this.#pause = kFirstPause;
    this.#tell("connected");
  }

  #address(path = "ws") {
    const address = new URL(path, location.href);
    address.search = new URLSearchParams({token: this.#token});
    return address;
  }

  async #closed() {
    ++this.failures;
    this.#tell("gone", {failures: this.failures, strange: this.failures > 1 && await this.#isStrange()});
    setTimeout(() => this.open(), this.#pause);
    this.#pause = Math.min(kLongestPause, this.#pause * 1.6);
  }

  // Whether the token is another studio's.
  async #isStrange() {
    try {
      return (await fetch(this.#address(), {cache: "no-store", signal: AbortSignal.timeout(kLongestPause)})).status === 403;
    } catch {
      return false;
    }
  }

  #take(data) {
    if (data instanceof ArrayBuffer) return this.#tell("picture", data);
    const message = JSON.parse(data);
    this.#tell(message.is, message);
  }

  #tell(is, what) { for (const listener of this.#listeners.get(is) ?? []) listener(what); }
}

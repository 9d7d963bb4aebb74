// What a test's hand needs of the studio's page: to act on a page that is settled, and on one that stands still while the
// hand acts. Otherwise the page could replace an element between the look that finds the element and the press of the
// mouse, and the press would be lost. This script runs before the page's own ones.

{
  const Plain = window.WebSocket, later = window.setTimeout, never = window.clearTimeout;
  const now = performance.now.bind(performance);  // a test may replace the page's clock
  const kept = [];  // what waits while the page is held: {act, timer}
  let socket = null, held = false, sent = 0, answered = () => {};

  // An answer to a question that the page did not ask.
  const isOurs = (data) => typeof data === "string" && data.length < 400 && JSON.parse(data).do === "settled";

  window.WebSocket = class extends Plain {
    constructor(...all) {
      super(...all);
      socket = this;
      this.addEventListener("message", (event) => this.#take(event));
      this.addEventListener("close", () => answered());
    }

    send(text) {
      const what = JSON.parse(text).do;
      if (what !== "painted" && what !== "frame") ++sent;  // a film that plays goes on with these
      super.send(text);
    }

    // The page's own listeners hear a kept message on its second way through this one.
    #take(event) {
      const {data} = event;
      if (!held && !isOurs(data)) return;
      event.stopImmediatePropagation();
      if (held) kept.push({act: () => this.dispatchEvent(new MessageEvent("message", {data}))});
      else answered();
    }
  };

  window.setTimeout = (act, ...rest) => {
    const timer = later(() => held ? kept.push({act, timer}) : act(), ...rest);
    return timer;
  };
  window.clearTimeout = (timer) => {
    const at = kept.findIndex((each) => timer !== undefined && each.timer === timer);
    if (at >= 0) kept.splice(at, 1);
    never(timer);
  };

  const frame = () => new Promise((done) => requestAnimationFrame(() => later(done)));

  // The studio refuses what it does not understand, after it has answered all that came before.
  const answer = () => new Promise((done) => {
    if (socket?.readyState !== Plain.OPEN) return done();
    answered = done;
    Plain.prototype.send.call(socket, '{"do": "settled"}');
  });

  // Everything that the page sent is answered, the page has heard the answers, and they made it send nothing more.
  async function settled() {
    for (let before = -1; before !== sent;) {
      before = sent;
      await frame();
      await answer();
    }
  }

  function release() {
    held = false;
    while (!held && kept.length > 0) kept.shift().act();
  }

  // Rows of the tree that are out of sight are no elements.
  function showInTree(selector) {
    const tree = document.querySelector("#tree [role=tree]");
    for (let top = 0; tree && !document.querySelector(selector) && top < tree.scrollHeight; top += tree.clientHeight / 2) {
      tree.scrollTop = top;
      tree.dispatchEvent(new Event("scroll"));
    }
  }

  const doesShow = (it) => it.getClientRects().length > 0;

  function find(selector, text) {
    showInTree(selector);
    const all = [...document.querySelectorAll(selector)].filter((it) => text === null || it.textContent === text);
    return all.find(doesShow) ?? all[0];
  }

  // The middle of the element, where the mouse finds it there; otherwise the reason why not.
  function placeOf(it) {
    if (!it) return "is not there";
    if (it.matches(":disabled")) return "is disabled";
    if (!doesShow(it)) return "does not show";
    let over = null;
    for (const block of ["nearest", "center"]) {
      it.scrollIntoView({block, behavior: "instant"});
      const at = it.getBoundingClientRect(), x = at.x + at.width / 2, y = at.y + at.height / 2;
      over = document.elementFromPoint(x, y);
      if (over && (it.contains(over) || over.contains(it) && over.matches("label"))) return {it, x, y};
    }
    return `is behind ${over?.outerHTML.slice(0, 200) ?? "nothing"}`;
  }

  // An element and where the mouse finds it, as soon as it does. The page stands still until release(). `text`: all that
  // the element says, or null.
  async function take(selector, text, patience) {
    for (const end = now() + patience;;) {
      await settled();
      held = true;
      const place = placeOf(find(selector, text));
      if (typeof place !== "string") return place;
      release();
      if (now() > end) throw new Error(`${selector} ${text ?? ""} ${place}`);
    }
  }

  const hold = async () => {
    await settled();
    held = true;
  };

  // The page hears and says nothing more, and does not look for its studio.
  function leave() {
    held = true;
    socket?.close();
  }

  window.hand = {settled, take, hold, release, leave};
}

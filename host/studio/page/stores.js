// The browser keeps values for the page. A browser may forbid that, or have no room: then nothing is kept.

class Store {
  #open;
  constructor(open) { this.#open = open; }  // may throw

  get(name) {
    try { return this.#open().getItem(name); } catch { return null; }
  }

  set(name, value) {
    try { this.#open().setItem(name, value); } catch { /* the page goes on without */ }
  }
}

export const ofTab = new Store(() => sessionStorage), ofBrowser = new Store(() => localStorage);

// Put into the page before its own scripts: when messages left, when pictures came, when they were painted.

window.marsProbe = {sent: new Map(), pictures: []};

{
  const probe = window.marsProbe, send = WebSocket.prototype.send;
  let painting = 0, parts = 0;

  WebSocket.prototype.send = function (text) {
    const {edit, do: what, view, picture} = JSON.parse(text);
    const now = performance.now();
    if (edit !== undefined) probe.sent.set(edit, now);
    if (what === "painted") {
      const painted = probe.pictures.findLast((each) => each.view === view && each.picture === picture);
      if (painted) Object.assign(painted, {said: now});
    }
    return send.call(this, text);
  };

  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...all) {
      super(...all);
      this.addEventListener("message", ({data}) => {
        if (!(data instanceof ArrayBuffer)) return;
        const head = new DataView(data), rects = head.getUint32(28, true);
        const [x, y, width, height] = rects > 0 ? new Uint16Array(data, 32 + 8 * (rects - 1), 4) : [];
        probe.pictures.push({
          view: head.getUint32(4, true), picture: head.getUint32(8, true), edit: head.getUint32(12, true),
          encoding: head.getUint16(24, true), flags: head.getUint16(26, true), rects,
          toEnd: x === 0 && width === head.getUint16(20, true) && y + height === head.getUint16(22, true),  // of all rows
          bytes: data.byteLength, came: performance.now(), paint: 0,
        });
      });
    }
  };

  for (const name of ["putImageData", "drawImage"]) {
    const paint = CanvasRenderingContext2D.prototype[name];
    CanvasRenderingContext2D.prototype[name] = function (...all) {
      const began = performance.now();
      const result = paint.apply(this, all);
      painting += performance.now() - began;
      ++parts;
      return result;
    };
  }
  const ask = window.requestAnimationFrame;
  window.requestAnimationFrame = (act) => ask((time) => {
    const began = performance.now();
    painting = parts = 0;
    act(time);
    if (parts === 0) return;
    for (const picture of probe.pictures.slice(-8))
      if (!picture.frame && picture.came < began)
        Object.assign(picture, {frame: began, paint: painting, script: performance.now() - began});
  });
}

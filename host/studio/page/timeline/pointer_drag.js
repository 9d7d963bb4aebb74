// A press, a way and a release on an element, as one gesture that Escape gives up. `begin(event)` says what the gesture
// is: {move(event, dx, dy), end(event, moved), giveUp()}, or null.

const kStill = 3;  // pixels: a press that moves less is a click

let held = null;

// Whether there was one.
export function giveUpDrag() {
  const had = held;
  held = null;
  had?.gesture.giveUp?.();
  return had !== null;
}

export function onDrag(target, begin) {
  target.addEventListener("pointerdown", (event) => {
    giveUpDrag();
    const gesture = begin(event);
    if (!gesture) return;
    event.preventDefault();
    target.setPointerCapture(event.pointerId);
    held = {target, gesture, x: event.clientX, y: event.clientY, moved: false};
  });
  target.addEventListener("pointermove", (event) => {
    if (held?.target !== target) return;
    const dx = event.clientX - held.x, dy = event.clientY - held.y;
    held.moved ||= Math.hypot(dx, dy) >= kStill;
    if (held.moved) held.gesture.move(event, dx, dy);
  });
  target.addEventListener("pointerup", (event) => {
    if (held?.target !== target) return;
    const {gesture, moved} = held;
    held = null;
    gesture.end?.(event, moved);
  });
  target.addEventListener("lostpointercapture", () => { if (held?.target === target) giveUpDrag(); });
}

// Dragging with a mouse, a pen or a finger: an element keeps the pointer from the press to the release.

/**
 * Call `move` while the element is dragged, and `end` when it is let go.
 * @param {HTMLElement} handle
 * @param {(event: PointerEvent) => any} start returns what `move` and `end` need, or null where nothing is dragged
 * @param {(held: any, event: PointerEvent) => void} move
 * @param {(held: any, event: PointerEvent | null) => void} [end] without an event where the browser cancels the drag
 */
export function onDrag(handle, start, move, end = () => {}) {
  let held = null
  handle.addEventListener("pointerdown", (event) => {
    held = start(event)
    if (held !== null) handle.setPointerCapture(event.pointerId)
  })
  handle.addEventListener("pointermove", (event) => { if (held !== null) move(held, event) })
  const release = (event) => {
    if (held !== null) end(held, event)
    held = null
  }
  handle.addEventListener("pointerup", release)
  handle.addEventListener("pointercancel", () => release(null))
}

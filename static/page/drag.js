// @ts-check
// Dragging with a mouse, a pen or a finger; the element captures the pointer from press to release.

/**
 * Call `move` while the element is dragged, and `end` when it is released.
 * @template {unknown[]} Held
 * @param {HTMLElement} handle
 * @param {(event: PointerEvent) => Held | null} start returns the values that `move` and `end` get; null to ignore the press
 * @param {(held: Held, event: PointerEvent) => void} move
 * @param {(held: Held, event: PointerEvent | null) => void} [end] gets no event if the browser cancels the drag
 */
export function onDrag(handle, start, move, end = () => {}) {
  /** @type {Held | null} */
  let held = null
  handle.addEventListener("pointerdown", (event) => {
    held = start(event)
    if (held !== null) handle.setPointerCapture(event.pointerId)
  })
  handle.addEventListener("pointermove", (event) => { if (held !== null) move(held, event) })
  /** @param {PointerEvent | null} event */
  const release = (event) => {
    if (held !== null) end(held, event)
    held = null
  }
  handle.addEventListener("pointerup", release)
  handle.addEventListener("pointercancel", () => release(null))
}

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
  /** @type {number | null} */
  let pointer = null
  /** @param {PointerEvent} event */
  const isHolding = ({ pointerId }) => held !== null && pointerId === pointer
  handle.addEventListener("pointerdown", (event) => {
    // A second finger does nothing.
    if (held !== null) return
    held = start(event)
    pointer = event.pointerId
    if (held !== null) handle.setPointerCapture(pointer)
  })
  handle.addEventListener("pointermove", (event) => { if (isHolding(event)) move(held, event) })
  /** @param {PointerEvent} event */
  const release = (event) => {
    if (!isHolding(event)) return
    end(held, event.type === "pointercancel" ? null : event)
    held = null
  }
  handle.addEventListener("pointerup", release)
  handle.addEventListener("pointercancel", release)
}

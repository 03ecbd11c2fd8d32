// @ts-check
// Dragging with a mouse, a pen or a finger; the element captures the pointer from press to release.

/**
 * Call `move` while the element is dragged, and `end` when it is released.
 * @template {unknown[]} Held
 * @param {HTMLElement} handle
 * @param {(event: PointerEvent) => Held | null} start returns the values that `move` and `end` get; null to ignore the press
 * @param {(held: Held, event: PointerEvent) => void} move
 * @param {(held: Held, event: PointerEvent | null) => void} [end] gets no event if the browser or a second finger cancels the drag
 */
export function onDrag(handle, start, move, end = () => {}) {
  /** @type {Held | null} */
  let held = null
  /** @type {number | null} */
  let pointer = null
  const cancel = () => {
    end(held, null)
    held = null
  }
  /** @param {PointerEvent} event */
  const isHolding = ({ pointerId }) => held !== null && pointerId === pointer
  handle.addEventListener("pointerdown", (event) => {
    // A second finger is not part of the drag.
    if (held !== null) return cancel()
    held = start(event)
    pointer = event.pointerId
    if (held !== null) handle.setPointerCapture(pointer)
  })
  handle.addEventListener("pointermove", (event) => { if (isHolding(event)) move(held, event) })
  /** @param {PointerEvent} event */
  const release = (event) => {
    if (!isHolding(event)) return
    if (event.type === "pointercancel") return cancel()
    end(held, event)
    held = null
  }
  handle.addEventListener("pointerup", release)
  handle.addEventListener("pointercancel", release)
}

// A number by dragging its label: across so many pixels it goes from end to end, where steps are not longer.

const FULL_DRAG = 400

// limits() → [low, high]; stepOf() is that of the slider, or 0; value() is where it stands; move(value) takes a place.
export function scrub(label, { limits, stepOf, value, move, isIdle }) {
  let grabbed = null
  label.addEventListener("pointerdown", (event) => {
    if (isIdle() || event.button !== 0) return
    label.setPointerCapture(event.pointerId)
    grabbed = [event.clientX, value()]
  })
  label.addEventListener("pointermove", (event) => {
    if (grabbed === null) return
    const [low, high] = limits()
    const steps = Math.max(1, Math.round((high - low) / FULL_DRAG / stepOf())) * (event.shiftKey ? 10 : 1)
    move(grabbed[1] + Math.round(event.clientX - grabbed[0]) * steps * stepOf())
  })
  for (const event of ["pointerup", "pointercancel"]) label.addEventListener(event, () => { grabbed = null })
}

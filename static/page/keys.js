// Who a key is for.

const TEXT_BOX = "textarea, [contenteditable], input:not([type=range], [type=checkbox], [type=radio])"

// Whether a key with Ctrl is for a text that is typed, or a dialog.  The box of a number says itself when it is.
export function isTyped(event) {
  return event.composedPath().some((item) => item instanceof HTMLElement && item.matches(`dialog, :is(${TEXT_BOX}):not(.exact)`))
}

// act() for a key of the page, {key in lower case: act}; false where it means nothing now.
export function onKeys(actions, target = document) {
  target.addEventListener("keydown", (event) => {
    const act = actions[event.key.toLowerCase()]
    if (act !== undefined && !isTaken(event) && act() !== false) event.preventDefault()
  })
}

// Whether the key is one that is typed, belongs to the browser, or to a dialog that covers the page.
export function isTaken(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return true
  // A menu finds its options by their letters.
  const typed = event.key.length === 1 && event.key !== " " ? `dialog, [popover], select, ${TEXT_BOX}` : `dialog, [popover], ${TEXT_BOX}`
  return event.composedPath().some((item) => item instanceof HTMLElement && item.matches(typed))
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }

/** Return where an arrow key points, as [right, up]; undefined for any other key. */
export const arrowOf = ({ key }) => ARROWS[key]

// @ts-check
// Decides which part of the page a key is for.

const TEXT_BOX = "textarea, [contenteditable], input:not([type=range], [type=checkbox], [type=radio])"

/**
 * Return whether an event comes from inside an element that matches a selector.
 * @param {Event} event
 * @param {string} selector
 */
const isWithin = (event, selector) => (
  event.composedPath().some((item) => item instanceof HTMLElement && item.matches(selector)))

/**
 * Return whether a key with Ctrl belongs to a text box or a dialog.  The box of a number decides for itself.
 * @param {KeyboardEvent} event
 */
export function isTyped(event) {
  return isWithin(event, `dialog, :is(${TEXT_BOX}):not(.exact)`)
}

/**
 * Call the action of a key that belongs to the page.
 * @param {Record<string, () => unknown>} actions key in lower case → action; it returns false if the key has no effect now
 * @param {Pick<Document, "addEventListener">} target
 */
export function onKeys(actions, target = document) {
  target.addEventListener("keydown", (event) => {
    const act = actions[event.key.toLowerCase()]
    if (act !== undefined && !isTaken(event) && act() !== false) event.preventDefault()
  })
}

/**
 * Return whether a key is typed, or belongs to the browser or to a dialog over the page.
 * @param {KeyboardEvent} event
 */
export function isTaken(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return true
  // A menu finds its options by their first letters.
  return isWithin(event, `dialog, [popover], ${event.key.length === 1 && event.key !== " " ? "select, " : ""}${TEXT_BOX}`)
}

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }

/**
 * Return the direction of an arrow key as [right, up]; undefined for any other key.
 * @param {{key: string}} event
 */
export const arrowOf = ({ key }) => ARROWS[key]

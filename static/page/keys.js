// Who a key is for.

const TEXT_BOX = "textarea, [contenteditable], input:not([type=range], [type=checkbox], [type=radio])"

// Whether the key is one that is typed, belongs to the browser, or to a dialog that covers the page.
export function isTaken(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return true
  // A menu finds its options by their letters.
  const typed = event.key.length === 1 && event.key !== " " ? `dialog, select, ${TEXT_BOX}` : `dialog, ${TEXT_BOX}`
  return event.composedPath().some((item) => item instanceof HTMLElement && item.matches(typed))
}

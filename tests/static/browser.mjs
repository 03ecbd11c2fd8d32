// Stand-ins for the few browser objects that the tested modules use.  Import this file before them.

/** An element that matches the selectors it is given. */
export class Element extends EventTarget {
  constructor(...selectors) {
    super()
    this.selectors = selectors
  }

  matches(selector) { return this.selectors.some((one) => selector.includes(one)) }
}

/** Dispatch a pointer event on the document, as if it came from an element. */
export function point(type, target, pointerType = "mouse") {
  const event = Object.assign(new Event(type), { pointerType })
  event.composedPath = () => [target]
  document.dispatchEvent(event)
}

Object.assign(globalThis, {
  Element, document: new EventTarget(), window: new EventTarget(), location: { search: "" },
  matchMedia: () => Object.assign(new EventTarget(), { matches: false }),
})

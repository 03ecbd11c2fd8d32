// @ts-check
// The events by which the parts of the page communicate; `PageEvents` in "types.d.ts" lists them.

const bus = new EventTarget()

/**
 * Dispatch an event.
 * @template {keyof PageEvents} Name
 * @param {Name} name
 * @param {PageEvents[Name]} [detail]
 */
export const tell = (name, detail) => { bus.dispatchEvent(new CustomEvent(name, { detail })) }

/**
 * Call listeners with the details of their events.
 * @param {PageListeners} listeners event name → listener
 */
export function listen(listeners) {
  for (const [name, hear] of Object.entries(/** @type {Record<string, (detail: unknown) => unknown>} */ (listeners))) {
    bus.addEventListener(name, (event) => hear(/** @type {CustomEvent} */ (event).detail))
  }
}

// @ts-check
// The address bar: the query of the state on show, and the browser's own keys (t, speed, az, el, large, present, theme).  A page
// in a file, whose name cannot change, has them after "#".

const PAUSE = 400

/**
 * Return the functions that write the address.
 * @param {{query: () => string, own: ClientKeys, mark: Host["mark"]}} page query() returns the query of the state on show
 */
export function createAddress({ query, own, mark }) {
  /** @type {ReturnType<typeof setTimeout> | null} */
  let timer = null
  /** @param {string} state */
  const addressOf = (state) => {
    const extra = Object.entries(own).filter(([, value]) => value !== "")
      .map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
    return `${mark}${state}${extra}`
  }
  const read = () => location[mark === "?" ? "search" : "hash"]
  const writeNow = () => {
    clearTimeout(timer)
    timer = null
    const wanted = addressOf(query())
    if (wanted !== read()) history.replaceState(null, "", wanted)
  }
  return {
    writeNow,
    /** Return the query in the address bar. */
    read: () => read().slice(1),
    /**
     * Add a history entry for the state on show; Back leads to the state before.
     * @param {string} before the query of that state
     */
    push(before) {
      history.replaceState(null, "", addressOf(before))
      history.pushState(null, "", addressOf(query()))
    },
    // Browsers limit how often the address can change.
    write: () => { timer ??= setTimeout(writeNow, PAUSE) },
  }
}

// @ts-check
// Words that the browser keeps from one visit to the next; without local storage, as long as the tab is open.

const PREFIX = "hess-explorer-"
/** @type {Map<string, string>} */
const here = new Map()

/** Whether this browser stores anything for the page. */
export const isStoring = (() => {
  try {
    return localStorage.length >= 0
  } catch (error) {
    console.info("This browser stores nothing for the page.", /** @type {Error} */ (error).message)
    return false
  }
})()

/** Return what is kept by this name, or null. @param {string} name */
export const kept = (name) => (isStoring ? localStorage.getItem(PREFIX + name) : here.get(name) ?? null)

/** @param {string} name @param {string} value */
export function keep(name, value) {
  here.set(name, value)
  try {
    localStorage.setItem(PREFIX + name, value)
  } catch {
    // The storage is closed or full.
  }
}

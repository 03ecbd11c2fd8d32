// @ts-check
// Texts in the storage of the browser: permanent, or until the tab is closed.  Without storage the page works, but forgets them.

const PREFIX = "hess-explorer-"

/** @param {() => Storage} area throws if the browser forbids it */
function createStore(area) {
  /**
   * @template Result
   * @param {(area: Storage) => Result} use
   * @param {Result} otherwise
   */
  const attempt = (use, otherwise) => {
    try {
      return use(area())
    } catch {
      return otherwise
    }
  }
  return {
    /** Return whether the storage can be used. */
    works: () => attempt((area) => area.length >= 0, false),
    /** @param {string} key @returns {string | null} */
    get: (key) => attempt((area) => area.getItem(PREFIX + key), null),
    /** @param {string} key @param {string | null} value null removes it */
    set: (key, value) => attempt((area) => (value === null ? area.removeItem(PREFIX + key) : area.setItem(PREFIX + key, value)), undefined),
  }
}

export const browserStore = createStore(() => localStorage)
export const tabStore = createStore(() => sessionStorage)

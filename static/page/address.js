// The address bar: the query of the state on show, what the browser itself keeps (t, speed, az, el, large), and the theme.

const PAUSE = 400

// query() and isDark() give the state's part and the theme; own: {key: text} of the browser.
export function createAddress({ query, isDark, own }) {
  let timer = null
  const writeNow = () => {
    clearTimeout(timer)
    timer = null
    const extra = Object.entries(own).filter(([, value]) => value !== "").map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
    const wanted = `?${query()}${extra}${isDark() ? "&theme=dark" : ""}`
    if (wanted !== window.location.search) window.history.replaceState(null, "", wanted)
  }
  return {
    writeNow,
    // Browsers limit how often the address may change.
    write: () => { timer ??= setTimeout(writeNow, PAUSE) },
  }
}

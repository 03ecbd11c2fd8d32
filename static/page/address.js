// The address bar: the query of the state on show, what the browser itself keeps (t, speed, az, el, large, present), and the theme.

const PAUSE = 400

// query() and isDark() give the state's part and the theme; own: {key: text} of the browser.
export function createAddress({ query, isDark, own }) {
  let timer = null
  const addressOf = (state) => {
    const extra = Object.entries(own).filter(([, value]) => value !== "").map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join("")
    return `?${state}${extra}${isDark() ? "&theme=dark" : ""}`
  }
  const writeNow = () => {
    clearTimeout(timer)
    timer = null
    const wanted = addressOf(query())
    if (wanted !== location.search) history.replaceState(null, "", wanted)
  }
  return {
    writeNow,
    // An entry of its own for the state on show: Back leads to the state before.
    push(before) {
      history.replaceState(null, "", addressOf(before))
      history.pushState(null, "", addressOf(query()))
    },
    // Browsers limit how often the address may change.
    write: () => { timer ??= setTimeout(writeNow, PAUSE) },
  }
}

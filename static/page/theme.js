// @ts-check
// The theme of the page: `color-scheme`, and the colours of text.

const TEXT = { light: "rgba(0, 0, 0, 0.87)", dark: "rgb(255, 255, 255)" }
const SECONDARY_TEXT = { light: "rgba(0, 0, 0, 0.6)", dark: "rgba(255, 255, 255, 0.7)" }

/** Return the functions that read and change the theme of this document. */
export function createTheme() {
  const root = document.documentElement
  return {
    isDark: () => root.style.colorScheme === "dark",
    /** @param {boolean} isDark */
    setDark(isDark) {
      const name = isDark ? "dark" : "light"
      root.style.colorScheme = name
      root.style.setProperty("--text", TEXT[name])
      root.style.setProperty("--secondary-text", SECONDARY_TEXT[name])
    },
  }
}

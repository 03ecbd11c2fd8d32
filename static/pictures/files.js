// @ts-check
// Pictures for files: drawn again at the size of the file, in the colours of a light or a dark page, at the time of the player.

import { tell } from "../base/bus.js"
import { element } from "../base/elements.js"
import { gallery } from "./gallery.js"
import { ink, onDark, setDark, shade } from "./looks.js"
import { sizePlot } from "./plot_looks.js"
import { pngOf } from "./png.js"

// Pixels of the page that take an inch on paper, see "views/elements.py": a letter of 14 pixels has 8.4 points.
const INCH = 120
const MILLIMETRES = 25.4
const DOTS = 300
const PAPER = "#FFFFFF"

// Heights of the lines above and below the picture in a film, and sizes of their letters.
const HEAD = 26
const LINE = 15
const [LARGE, SMALL] = [14, 10.5]
const BESIDE = 8
const FONT = "system-ui, sans-serif"

/** @typedef {{picture: string, side: number, ratio: number, isDark?: boolean, isBlack?: boolean, texts?: LiftedText[]}} Wanted */

/** Return a square sheet of paper and its context. @param {number} side */
function sheetOf(side) {
  const sheet = element("canvas", { width: side, height: side })
  const ctx = sheet.getContext("2d", { alpha: false })
  ctx.fillStyle = shade(PAPER)
  ctx.fillRect(0, 0, side, side)
  return { sheet, ctx }
}

/**
 * Call `act` in the colours of a dark or a light page.
 * @template Result
 * @param {boolean} isDark
 * @param {() => Result} act
 */
function inTheme(isDark, act) {
  const before = onDark()
  setDark(isDark)
  try {
    return act()
  } finally {
    setDark(before)
  }
}

/** Return a picture of the scene on show, `side` pixels wide, with `ratio` pixels for each of the page's. @param {Wanted} wanted */
function draw({ picture, side, ratio, isDark = false, isBlack = false, texts }) {
  return inTheme(isDark, () => {
    const { sheet, ctx } = sheetOf(side)
    const look = { edge: side / ratio, ratio, text: shade(ink()), dark: isDark, isFine: true, texts }
    ctx.drawImage(gallery.shown.shots.get(picture)(look), 0, 0)
    if (isBlack) {
      // Remove the colours of the theme.
      ctx.globalCompositeOperation = "saturation"
      ctx.fillStyle = ink()
      ctx.fillRect(0, 0, side, side)
    }
    return sheet
  })
}

/** @param {string} picture @param {number} width in millimetres @param {boolean} isBlack @returns {Wanted} */
const onPaper = (picture, width, isBlack) => ({ picture, side: Math.round(DOTS * width / MILLIMETRES), ratio: DOTS / INCH, isBlack })

/**
 * Return a picture of the scene on show as a PNG file of 300 dots per inch.
 * @param {string} picture
 * @param {number} width in millimetres
 * @param {boolean} isBlack whether it is black on white
 * @param {Record<string, string>} facts texts by keyword
 */
export const pictureFile = (picture, width, isBlack, facts) => pngOf(draw(onPaper(picture, width, isBlack)), DOTS, facts)

/** Return a file as a data URL, for Python. @param {Blob} file @returns {Promise<string>} */
const urlOf = (file) => new Promise((resolve) => {
  const reader = new FileReader()
  reader.onload = () => resolve(/** @type {string} */ (reader.result))
  reader.readAsDataURL(file)
})

/** See `pictureFile`. @param {Parameters<typeof pictureFile>} wanted */
export const pictureUrl = async (wanted) => urlOf(await pictureFile(...wanted))

/**
 * Return the image of a picture without its texts, and its texts, in the pixels of the page.
 * @param {[picture: string, width: number, isBlack: boolean]} wanted
 */
export async function imageAndTexts([picture, width, isBlack]) {
  /** @type {LiftedText[]} */
  const texts = []
  const wanted = onPaper(picture, width, isBlack)
  const image = await urlOf(await pngOf(draw({ ...wanted, texts }), DOTS, {}))
  return { image, texts, edge: wanted.side / wanted.ratio }
}

/** Give a plot its size in a film, and wait until it has it and the data of this time. @param {string} picture @param {number} edge */
async function settle(picture, edge) {
  const plot = gallery.plot(picture)
  if (plot === undefined) return
  if (plot.bbox.width !== edge) {
    /** @type {HTMLElement} */
    const host = gallery.cell(picture).querySelector(".host")
    host.style.width = host.style.height = `${edge}px`
    sizePlot(plot, LARGE, false, edge)
    while (plot.bbox.width !== edge) await new Promise(requestAnimationFrame)
  }
  await Promise.all(plot.computed_renderer_views.map(({ ready }) => ready))
}

/**
 * Return a frame of a film as a data URL: title and time above the picture, lines below it.
 * @param {Wanted & {t: number, title: string, lines: string[]}} wanted
 */
export async function frameUrl({ t, title, lines, ...wanted }) {
  tell("follow", t)
  const { side, ratio } = wanted
  const wide = side / ratio
  const below = lines.length === 0 ? 0 : BESIDE + LINE * lines.length
  const edge = Math.floor(wide - HEAD - below)
  await settle(wanted.picture, edge)
  const drawn = draw({ ...wanted, side: Math.round(ratio * edge) })
  return inTheme(wanted.isDark, () => {
    const { sheet, ctx } = sheetOf(side)
    ctx.drawImage(drawn, Math.round((side - drawn.width) / 2), Math.round(ratio * HEAD))
    ctx.scale(ratio, ratio)
    ctx.fillStyle = shade(ink())
    ctx.font = `${LARGE}px ${FONT}`
    const time = `t = ${t.toFixed(2)}`
    const clock = ctx.measureText("t = 000.00").width
    ctx.fillText(time, wide - BESIDE - clock, HEAD - BESIDE)
    ctx.fillText(title, BESIDE, HEAD - BESIDE, wide - clock - 3 * BESIDE)
    ctx.font = `${SMALL}px ${FONT}`
    lines.forEach((line, i) => ctx.fillText(line, BESIDE, HEAD + edge + LINE * (i + 1), wide - 2 * BESIDE))
    return sheet.toDataURL()
  })
}

// Numbers at the ticks of an axis.

const FAR_BELOW = 1e-3
const FAR_ABOVE = 1e5

/** Return about `count` round numbers from low to high. */
export function roundNumbers(low, high, count) {
  const rough = (high - low) / count
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough)
  const found = []
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) found.push(i * step)
  return found
}

/** Return the labels of ticks, as short as they can be; where they have more than so many `letters`, of each second or third. */
export function tickLabels(ticks, letters) {
  const most = Math.max(...ticks.map(Math.abs))
  const far = most < FAR_BELOW || most >= FAR_ABOVE
  const short = (x) => {
    if (Math.abs(x) < 1e-9 * most) return "0"
    const rounded = Number(x.toPrecision(9))
    return (far ? rounded.toExponential().replace("e+", "e") : String(rounded)).replaceAll("-", "−")
  }
  const labels = ticks.map(short)
  const every = Math.ceil(labels.reduce((sum, label) => sum + label.length, 0) / letters)
  return labels.map((label, i) => (i % every === 0 ? label : ""))
}

/** Return a formatter of Bokeh that writes them; letters() is for how many there is room. */
export function tickFormatter(letters) {
  class ShortNumbers extends Bokeh.Models.BasicTickFormatter {
    doFormat(ticks) { return tickLabels(ticks, letters()) }
  }
  return new ShortNumbers()
}

// Numbers at the ticks of an axis.

const FAR_BELOW = 1e-3
const FAR_ABOVE = 1e5

// As short as they can be, and where they have more than so many `letters` only each second or third.
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

// A formatter of Bokeh that writes them; letters() is for how many there is room.
export function tickFormatter(letters) {
  class ShortNumbers extends Bokeh.Models.BasicTickFormatter {
    doFormat(ticks) { return tickLabels(ticks, letters()) }
  }
  return new ShortNumbers()
}

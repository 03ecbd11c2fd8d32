// Numbers at the ticks of an axis, for Bokeh's CustomJSTickFormatter (`tick`, `index`, `ticks` are given): as short as
// they can be, and where they have more than so many `letters`, each second or third only.

const most = Math.max(...ticks.map(Math.abs))
const far = most < 1e-3 || most >= 1e5
const short = (x) => {
  if (Math.abs(x) < 1e-9 * most) return "0"
  const rounded = Number(x.toPrecision(9))
  return (far ? rounded.toExponential().replace("e+", "e") : String(rounded)).replaceAll("-", "−")
}
const every = Math.ceil(ticks.reduce((sum, x) => sum + short(x).length, 0) / letters)
return index % every === 0 ? short(tick) : ""

// Colours, dashes and weights on our own canvases; "theme.py" has the same for Bokeh.  null: the colour of text.

export const LOOKS = {
  orbit: { colour: "#0072B2", dash: [], weight: 2.2 },
  second: { colour: "#CC79A7", dash: [], weight: 2.2 },
  stable: { colour: "#009E73", dash: [], weight: 3 },
  unstable: { colour: "#D55E00", dash: [7, 5], weight: 3 },
  limit: { colour: null, dash: [2, 3], weight: 1 },
  muted: { colour: "#808080", dash: [], weight: 1 },
  axis: { colour: null, dash: [], weight: 2.5 },
  mass: { colour: "#F0E442", dash: [], weight: 3 },
}
export const POINT = "#F0E442"
export const CLOUDS = [[0, 114, 178], [204, 121, 167]]

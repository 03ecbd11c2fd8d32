// Types that several modules share.  Messages and descriptions have the field names of "protocol/messages.py" and
// "page/description.py".

/** Three coordinates in space. */
type Vector = number[]
/** A curve in space as three columns [xs, ys, zs]. */
type Columns = ArrayLike<number>[]

type Tag<Name extends string> = Name extends `${infer First}.${string}` ? First : Name
/** The element that `element("p.why")` makes. */
type ElementOf<Name extends string> =
  Tag<Name> extends keyof HTMLElementTagNameMap ? HTMLElementTagNameMap[Tag<Name>] : HTMLElement

// ---- BokehJS: the members that the page uses ----

interface BokehScale {
  compute(value: number): number
  v_compute(values: ArrayLike<number>): ArrayLike<number>
  invert(pixel: number): number
}

/** The part of a scale that a canvas over a plot uses. */
type Scale = Pick<BokehScale, "compute" | "invert">

interface BokehSignal {
  connect(slot: () => void): void
  disconnect(slot: () => void): void
}

/** Any model of Bokeh; its properties depend on its type. */
interface BokehModel {
  name: string | null
  setv(properties: object, options?: { sync: boolean }): void
  [property: string]: any
}

interface BokehRange extends BokehModel {
  start: number
  end: number
}

/** x0, x1, y0, y1 of a planar picture. */
type Axes = [number, number, number, number]
/** The rectangle between the axes, in pixels. */
interface Frame { x0: number, x1: number, y0: number, y1: number }

interface PlotModel extends BokehModel {
  x_range: BokehRange
  y_range: BokehRange
  x_scale: BokehModel & { type: string }
  y_scale: BokehModel & { type: string }
  inner_width: number
  inner_height: number
  below: BokehModel[]
  left: BokehModel[]
  renderers: BokehModel[]
  references(): Iterable<BokehModel>
}

interface BokehLayer { el: HTMLCanvasElement }

interface GlyphView {
  set_data(): void
  set_visuals(source: object, indices: object): void
  after_visuals(): void
  after_lazy_visuals(): void
  map_data(): void
  mask_data(): object
}

interface RendererView {
  glyph?: Partial<GlyphView>
  selection_glyph?: GlyphView
  nonselection_glyph?: GlyphView
  muted_glyph?: GlyphView
  decimated_glyph?: GlyphView
  model: BokehModel
  all_indices: object
  update_position(): void
  ready: Promise<void>
  el: Element
}

/** Bokeh's view of a plot. */
interface PlotView {
  model: PlotModel
  frame: { bbox: Frame & { width: number }, x_scale: BokehScale, y_scale: BokehScale }
  bbox: { width: number, height: number }
  canvas_view: { primary: BokehLayer, overlays: BokehLayer, resize(): void }
  computed_renderer_views: RendererView[]
  repainted: BokehSignal
  is_paused: boolean
  pause(): void
  unpause(noReset?: boolean): void
  paint(): void
  invalidate_painters(): void
  has_finished(): boolean
}

interface BokehEvent { x: number, y: number, event_name: string }

declare const Bokeh: any

// ---- Descriptions of scenes and lessons ----

type ControlDescription = { name: string, label: string, help: string, group: string } & (
  { kind: "number", symbol: string, range: [number, number], options?: undefined } |
  { kind: "choice", symbol?: undefined, range?: undefined, options: string[] } |
  { kind: "formula", symbol?: undefined, range?: undefined, options?: undefined })

/** A picture of a scene; the fields beyond these depend on its kind. */
interface PictureDescription {
  name: string
  kind: "plot" | "sphere" | "torus" | "cloud"
  hands: string
  /** Whether a click chooses where the motion starts. */
  starts: boolean
  folded: string | null
  [option: string]: any
}

interface AnimationDescription {
  name: string
  start: number
  end: number
  seconds: number
}

interface Prediction {
  picture: string
  source: string
  columns: [string, string]
  what: "point" | "curve"
}

interface LessonStep {
  title: string
  text: string
  scene: string
  look: string
  /** Names of the pictures that are shown alone; none with the whole page. */
  pictures: string[]
  question: string
  answer: string
  /** Names of parameters. */
  controls: string[]
  animation?: AnimationDescription
  hide?: { picture: string, source: string }
  prediction?: Prediction
}

interface Lesson {
  name: string
  title: string
  minutes: number
  steps: LessonStep[]
}

type Handle = { control: string } | { picture: string, source: string, columns?: string[] }

interface SceneDescription {
  name: string
  title: string
  pictures: PictureDescription[]
  controls: ControlDescription[]
  essential: string[]
  handle: Handle | null
  moves: string
  /** Names of the pictures that lead. */
  lead: string[]
  groups: string[]
  drawn: boolean
  presets: string[]
  legend: string
  words: string
  tries: LessonStep[]
  tracks: string[]
  dots: Record<string, [string, string]>
  angles: string[]
  shades: Record<string, [string, string]>
  /** Pictures that an embedded page leaves out. */
  absent?: string[]
}

// ---- Messages of the websocket ----

/** [value, low, high, step, whether the control is disabled], or the option of a menu. */
type ControlValue = [number, number, number, number, boolean?] | string
type Texts = Record<string, string>
/** The words over a picture, see "views/caption.py". */
type Caption = { title: string, verdict: string, numbers: string }
type Progress = [done: number, of: number]

/** A state as a tree; `sources` refers to the block of numbers, see "protocol/wire.py". */
interface Tree {
  sources: Record<string, Record<string, unknown>>
  ranges: Record<string, Axes>
  texts: Texts
  captions: Record<string, Caption>
  controls: Record<string, ControlValue>
}

interface StateAnswer {
  number: number
  answers: number
  query: string
  tree: Tree
  scene: string
  progress: Progress | null
}

/** `Answer` of "protocol/messages.py", without its block. */
interface Answer {
  state?: StateAnswer
  scene?: SceneDescription
  lesson?: Lesson
  show?: Followed
}

/** Text for the followers of a room: `lesson` is its title, `number` the number of the step. */
interface Followed {
  scene: string
  number: number
  revealed: boolean
  step: LessonStep | null
  lesson?: string
}

/** A point [picture, x, y] or a box [picture, x0, y0, x1, y1]. */
type Picked = [picture: string, ...numbers: number[]]

/** `Request` of "protocol/messages.py". */
interface StateRequest {
  requested: number
  held: boolean
  values: Record<string, number | string>
  scene: string | null
  hidden: string[] | null
  expressions?: Texts
  picked?: Picked
  hover?: Picked
  lesson?: string
  step?: [lesson: string, number: number, revealed: boolean]
  near?: string
  preset?: string
  restore?: string
  reset?: true
  clear?: true
  stop?: true
}

// ---- The page ----

/** Columns of a data source by name. */
type Data = Record<string, any>
type Source = import("./pictures/sources.js").Source
type FindSource = (name: string) => Source

/** Numbers on a grid, row by row. */
interface Grid {
  rows: number
  columns: number
  numbers: Float32Array
}

/** Look of an earlier state; its form depends on the kind of the picture. */
type GhostImage = any
/** A faint copy of an earlier state: take() copies the state on show, show(copy or null) draws it. */
interface Ghost {
  take(): GhostImage
  show(image: GhostImage): void
}

/** A picture that was drawn; shoot(look) draws it again on a canvas of its own. */
interface Drawn extends Partial<Ghost> {
  shoot(look: ShotLook): HTMLCanvasElement
  plot?: PlotView
}

/** The pictures of a scene, built. */
interface Scene {
  name: string
  /** Names of the pictures that lead; a phone shows the first. */
  lead: string[]
  grid: HTMLElement
  sources: Map<string, Source>
  /** Returns a source, a new one under a new name. */
  source: FindSource
  cells: HTMLElement[]
  plots: PlotView[]
  /** Axes by picture: of the state, and of the other page if two states stand side by side. */
  ranges: Record<string, Axes>
  beside: Record<string, Axes>
  ghosts: Ghost[]
  shots: Map<string, Drawn["shoot"]>
  /** Whether its plots are built, and whether a state was painted in all its pictures. */
  isComplete: boolean
  painted: boolean
  /** The sizes that each plot has. */
  sizes: Map<PlotView, string>
}

/** A painted canvas: its side in its own units, device pixels per unit, colour of text, theme; `isFine`: shaded as finely as print needs. */
interface SquareLook { edge: number, ratio: number, text: string, dark: boolean, isFine?: boolean }
/** `texts` collects the texts, which are then not drawn. */
interface ShotLook extends SquareLook { texts?: LiftedText[] }
/** A text of a picture: place, turn counterclockwise, size, colour and alignment as on a canvas, in the picture's own units. */
interface LiftedText {
  text: string
  x: number
  y: number
  turn: number
  size: number
  colour: string
  alpha: number
  align: CanvasTextAlign
  baseline: CanvasTextBaseline
}
type PaintSquare = (ctx: CanvasRenderingContext2D, look: SquareLook) => void
/** `larger` is the factor of the sizes of lines and dots. */
type PaintFrame = (ctx: CanvasRenderingContext2D, xScale: BokehScale, yScale: BokehScale, larger: number) => void

/** Line style; without a colour, that of text. */
interface Look {
  colour?: string
  dash?: number[]
  weight: number
}

type Sheet = ReturnType<typeof import("./pictures/projection.js").createSheet>

/** A drawing on a sphere; begin, paint (far, then near half) and middle (between them) are called in this order. */
interface SphereGuest {
  begin?(sheet: Sheet): void
  paint(sheet: Sheet, near: boolean): void
  middle?(sheet: Sheet): void
}

/** Keys of the address that the browser itself keeps. */
type ClientKeys = Record<string, string>

/** A state as `compare.js` keeps it. */
interface Compared {
  title: string | null
  isPinnedShown: boolean
  rows: [string, string, string][]
  queries: [string, string]
}

/** Options of the export dialog: [kind, label, content] of each format; [least, most, usual] of the numbers. */
interface ExportFiles {
  /** Name and version. */
  program: string
  formats: [string, string, string][]
  width: [number, number, number]
  seconds: [number, number, number]
}

/** picture: name of a file without theme and suffix, "" for none; examples: their names, to be searched. */
interface SceneTile {
  name: string
  title: string
  summary: string
  picture: string
  examples: string
  origin: string | null
  group: string
}

/** The model of the page's component, see "page/component.py". */
interface PageModel {
  client: ClientKeys
  lesson: string
  lessons: { name: string, title: string, minutes: number }[]
  scenes: SceneTile[]
  files: ExportFiles
  sheets: Record<string, string>
}

/** Where the page lives: beside its server, or in a file. */
interface Host {
  /** The part of the address that holds the state. */
  mark: "?" | "#"
  /**
   * Connect, and return the function that sends messages.  `lost` hears that there will be no more answers, with a reason if the
   * host gave one; `silent` hears that the host does not respond, or does again.
   */
  connect(
    receive: (head: Answer, block: ArrayBuffer) => void, lost: (why: string) => void, silent: (on: boolean) => void,
  ): (message: StateRequest) => void
  /** Wait until a lost host answers again. */
  answering(): Promise<void>
}

/** The events of "base/bus.js", by name, with their details. */
interface PageEvents {
  /** The pictures that are shown alone, over the text of their step; none with the whole page. */
  alone: string[]
  // To the client
  change: Record<string, number | string>
  expression: Texts
  preset: string
  scene: string
  near: string
  restore: string
  reset: void
  undo: void
  redo: void
  clear: void
  stop: void
  /** Write the address bar, which may lag behind the screen. */
  address: void
  theme: void
  fullscreen: void
  present: void
  share: void
  invite: void
  "open-room": void
  "end-room": void
  export: void
  pick: { pick: Picked, drag: boolean }
  hover: Picked
  pin: void
  flip: void
  url: ClientKeys
  lesson: string
  step: [lesson: string, number: number, revealed: boolean]
  "ask-client": (hear: ClientKeys) => void
  // From the client
  enter: SceneDescription
  texts: Texts
  captions: Record<string, Caption>
  controls: Record<string, ControlValue>
  progress: Progress | null
  client: ClientKeys
  /** Canvases paint now, together with the plots. */
  paint: void
  painted: void
  /** The colours of the page have changed. */
  themed: void
  /** How many steps can be undone and redone. */
  steps: { undo: number, redo: number }
  presenting: boolean
  "lesson-read": { lesson: Lesson, step: number | null }
  compared: Compared | null
  // From the player
  time: { t: number, state: Record<string, number> | null }
  fold: string
  /** Something beside the answer is unfolded, or folded: "details" or "text". */
  unfolding: { name: string, on: boolean }
  folded: { name: string, folded: boolean }
  // From a picture and to it: [picture, azimuth, elevation]
  turned: [string, number, number]
  turn: [string, number, number]
  // From the painter: the axes of a scene by picture
  axes: { name: string, ranges: Scene["ranges"] }
  // From the other page of two side by side
  follow: number
  "axes-beside": PageEvents["axes"]
  // From a room: of the lecturer (code is null when it has ended), the guesses of the audience, the step that is followed
  room: { code: string | null, address: string, followers: number, said: string }
  audience: string
  followed: Followed
  // From a lesson
  reading: boolean
  look: string
  run: { from: number, to: number, seconds: number } | null
}

type PageListeners = { [Name in keyof PageEvents]?: (detail: PageEvents[Name]) => unknown }

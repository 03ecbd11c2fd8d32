// How the parts of the page speak to each other.  Every module of the page imports the same instance.
//
// To the client ("client.js"):            change {name: value}, preset name, scene name, near name, restore query,
//                                         expression {name: text}, reset, undo, redo, clear, stop, link, address,
//                                         copy text, theme, fullscreen, present, print, pick {pick, drag}, hover [picture, x, y],
//                                         animated boolean, pin, flip, folded {name, folded}, url {key: text}, lesson name,
//                                         step [lesson, number, revealed], ask-client hear(client),
//                                         ask-chart message, see "protocol/messages.py"
// From the client to whoever is concerned: enter description, texts {key: text}, controls {name: value},
//                                         progress [done, of] or null, client {key: text}, paint,
//                                         copied {text or null, said}, steps {undo: number, redo: number},
//                                         presenting boolean, embedding, painted,
//                                         lesson-read {lesson, step},
//                                         compared {title, isPinnedShown, rows, queries},
//                                         charted {head, cells}
// From the player to the pictures:         time {t, state}, fold name
// From a picture, and to it:               turned [picture, azimuth, elevation], turn the same
// From another page beside this one:       follow t, turn
// From a chart to the bar:                 charting share of its cells, or null
// From a lesson:                           reading on, look picture, run {from, to, seconds} or null

const bus = new EventTarget()

export const tell = (name, detail) => { bus.dispatchEvent(new CustomEvent(name, { detail })) }

// hears: {name of an event: hear(detail)}.
export function listen(hears) {
  for (const [name, hear] of Object.entries(hears)) bus.addEventListener(name, ({ detail }) => hear(detail))
}

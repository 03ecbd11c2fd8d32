// @ts-check
// Starts a page in a file: decompresses its code, which is Bokeh and the modules of the page, and runs it.  The only script of
// the file that is not compressed.

/** @param {string} text @param {string} type */
const run = (text, type) => { document.head.append(Object.assign(document.createElement("script"), { type, textContent: text })) }

async function load() {
  const packed = Uint8Array.from(atob(document.getElementById("code").textContent), (letter) => letter.charCodeAt(0))
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"))
  const { bokeh, modules, entry } = JSON.parse(await new Response(stream).text())
  run(bokeh, "text/javascript")
  // Modules name each other by their paths, which the map resolves.
  run(JSON.stringify({ imports: modules }), "importmap")
  run(`import ${JSON.stringify(entry)}`, "module")
}

load()

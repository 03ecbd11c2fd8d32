// @ts-check
// Starts a page in a file: decompresses its code, which is Bokeh and the modules of the page, and runs it.  The only script of
// the file that is not compressed.

/** @param {string} text @param {string} type @param {string} [id] */
const run = (text, type, id = "") => { document.head.append(Object.assign(document.createElement("script"), { id, type, textContent: text })) }

async function load() {
  const { body } = await fetch(`data:;base64,${document.getElementById("code").textContent}`)
  const code = body.pipeThrough(new DecompressionStream("deflate"))
  const { bokeh, page } = await new Response(code).json()
  // Not run yet, see "pictures/bokeh.js".
  run(bokeh, "text/plain", "bokeh")
  run(JSON.stringify({ imports: { page } }), "importmap")
  run('import "page"', "module")
}

load()

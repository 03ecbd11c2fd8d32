// @ts-check
// Starts a page in a file: decompresses its code, which is Bokeh and the modules of the page, and runs it.  The only script of
// the file that is not compressed.

async function load() {
  const { body } = await fetch(`data:;base64,${document.getElementById("code").textContent}`)
  const code = body.pipeThrough(new DecompressionStream("deflate"))
  const { bokeh, page } = await new Response(code).json()
  // Bokeh does not run yet, see "pictures/plot.js".
  const held = Object.assign(document.createElement("script"), { id: "bokeh", type: "text/plain", textContent: bokeh })
  document.head.append(held)
  await import(page)
}

load()

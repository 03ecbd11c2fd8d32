// @ts-check
// The script of the table of contents of a site: registers the service worker, and keeps all pages for reading offline.

const keep = /** @type {HTMLButtonElement} */ (document.getElementById("keep"))

/** Fetch all pages through the worker, which keeps them. */
async function keepAll() {
  keep.disabled = true
  const pages = /** @type {HTMLAnchorElement[]} */ ([...document.querySelectorAll("a.page")])
  const addresses = [...new Set([location.href, ...pages.map(({ href }) => href)].map((href) => href.split("#")[0]))]
  let done = 0
  try {
    for (const address of addresses) {
      await (await fetch(address)).arrayBuffer()
      done += 1
      keep.textContent = `Kept ${done} of ${addresses.length} pages`
    }
    keep.textContent = "All pages can be read offline"
  } catch {
    keep.textContent = `Kept ${done} of ${addresses.length} pages: the network was lost. Try again.`
    keep.disabled = false
  }
}

// From a disk everything is there already.
if (/^https?:$/.test(location.protocol) && "serviceWorker" in navigator) {
  const { serviceWorker: workers } = navigator
  keep.addEventListener("click", keepAll)
  const show = () => { keep.hidden = workers.controller === null }
  workers.addEventListener("controllerchange", show)
  workers.register("service_worker.js").then(show).catch(() => {})
}

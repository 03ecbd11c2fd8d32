// @ts-check
// Service worker of the installed app: it shows a page that says what to do while the server cannot be reached.  It keeps
// nothing else, and every other request goes to the network untouched.

const worker = /** @type {any} */ (self)
const PAGE = "offline.html"
const CACHE = "hess-explorer-offline"

worker.addEventListener("install", (/** @type {any} */ event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.add(new Request(PAGE, { cache: "reload" }))))
})

worker.addEventListener("fetch", (/** @type {any} */ event) => {
  // Pages in their own window only: not those embedded in another one, and no data.
  if (event.request.mode !== "navigate" || event.request.destination !== "document") return
  event.respondWith(fetch(event.request).catch(async () => (await caches.match(PAGE)) ?? Response.error()))
})

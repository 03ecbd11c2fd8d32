// @ts-check
// Service worker of a site of files: it keeps each page that was opened, so that it can be read again without a network.  The
// builder of the site replaces VERSION.

const site = /** @type {any} */ (self)
const KEPT = "hess-explorer-site-VERSION"

// At once, so that the page that registers it can keep the others.
site.addEventListener("install", () => site.skipWaiting())

site.addEventListener("activate", (/** @type {any} */ event) => {
  event.waitUntil((async () => {
    await site.clients.claim()
    for (const name of await caches.keys()) if (name.startsWith("hess-explorer-site-") && name !== KEPT) await caches.delete(name)
  })())
})

site.addEventListener("fetch", (/** @type {any} */ event) => {
  if (event.request.method !== "GET") return
  event.respondWith((async () => {
    const cache = await caches.open(KEPT)
    const kept = await cache.match(event.request, { ignoreSearch: true })
    if (kept) return kept
    const answer = await fetch(event.request)
    if (answer.ok) await cache.put(event.request, answer.clone())
    return answer
  })())
})

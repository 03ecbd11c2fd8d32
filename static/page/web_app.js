// @ts-check
// The page as an installed app: registers the service worker, which only an app in a window of its own needs.

const isServed = /^https?:$/.test(location.protocol) && window.top === window && "serviceWorker" in navigator

/** Register the worker beside the page, also behind a proxy that adds a folder. */
const register = () => navigator.serviceWorker.register(new URL("service_worker.js", document.baseURI)).catch(() => {})

if (isServed) {
  if (matchMedia("(display-mode: standalone)").matches) register()
  window.addEventListener("appinstalled", register)
}

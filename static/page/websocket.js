// @ts-check
// The websocket of requests and answers, see "protocol/messages.py".

const LENGTHS = 8
// Close code of a server without room for another session.
const FULL = 1013

// Milliseconds between attempts to reach a server that has restarted, or that was lost while the machine slept.
const FIRST = 1000
const LONGEST = 15000
// A frozen server accepts connections but does not answer.
const ATTEMPT = 5000

// Seconds without a message after which the page asks whether the server is alive, says that it does not respond, and tries
// whether it answers a new connection.
const ASKED = 4
const SILENT = 8
const DEAD = 20

const decoder = new TextDecoder()

/**
 * Return the parts of a frame.
 * @param {ArrayBuffer} data
 * @returns {{head: Answer, block: ArrayBuffer}}
 */
export function decode(data) {
  const lengths = new DataView(data, 0, LENGTHS)
  const block = LENGTHS + lengths.getUint32(0, true)
  const head = JSON.parse(decoder.decode(new Uint8Array(data, LENGTHS, block - LENGTHS)))
  return { head, block: data.slice(block, block + lengths.getUint32(4, true)) }
}

/** Return whether the server answers a new connection. */
const isAlive = () => fetch(new URL("liveness", document.baseURI), { cache: "no-store", signal: AbortSignal.timeout(ATTEMPT) })
  .then(({ ok }) => ok, () => false)

/**
 * Watch whether a websocket still delivers messages: a frozen server and a broken route close nothing.
 * @param {WebSocket} socket
 * @param {(on: boolean) => void} silent is called with true when the server does not respond, with false when it does again
 * @param {() => void} dead is called when it responds only to a new connection
 */
export function watch(socket, silent, dead) {
  // Seconds in which timers run: not those in which the machine slept.
  let seconds = 0
  const retry = async () => {
    if (!await isAlive()) return
    // A working server answers here too.
    await new Promise((done) => setTimeout(done, 1000))
    if (seconds >= DEAD) dead()
  }
  const timer = setInterval(() => {
    // The timers of a hidden page run late.
    if (document.hidden) return
    seconds += 1
    if (seconds === ASKED && socket.readyState === WebSocket.OPEN) socket.send('{"alive": true}')
    if (seconds === SILENT) silent(true)
    // Early, because the first attempts may go through connections that are as dead.
    if (seconds >= SILENT && seconds % ASKED === 0) retry()
  }, 1000)
  socket.addEventListener("message", () => {
    if (seconds >= SILENT) silent(false)
    seconds = 0
  })
  socket.addEventListener("close", () => clearInterval(timer))
}

/**
 * Open the websocket and return the function that sends messages.
 * @type {Host["connect"]}
 */
export function openWebsocket(receive, lost, silent) {
  // The query names the first state; any worker can answer.
  const url = new URL(`states${location.search}`, document.baseURI)
  // The server names a part after "#" in a note, because it does not belong to a link.
  if (location.hash) url.searchParams.append(location.hash.split("=")[0], "")
  url.protocol = url.protocol.replace("http", "ws")
  const socket = new WebSocket(url)
  socket.binaryType = "arraybuffer"
  socket.addEventListener("message", ({ data }) => {
    // Only the answer to "alive" is a text frame.
    if (typeof data === "string") return
    const { head, block } = decode(data)
    receive(head, block)
  })
  socket.addEventListener("close", ({ code, reason }) => lost(code === FULL ? reason : ""))
  watch(socket, silent, () => lost(""))
  return (message) => socket.send(JSON.stringify(message))
}

/** Wait until the server answers; pauses are random, so that a class of browsers does not reconnect at once. */
export async function answering() {
  for (let pause = FIRST; ; pause = Math.min(2 * pause, LONGEST)) {
    await new Promise((done) => setTimeout(done, pause * (0.5 + Math.random())))
    if (await isAlive()) return
  }
}

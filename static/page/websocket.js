// @ts-check
// The websocket of requests and answers, see "protocol/messages.py".

const LENGTHS = 8
// Close code of a server without room for another session.
const FULL = 1013

// Milliseconds between attempts to reach a server that has restarted, or that was lost while the machine slept.
const FIRST = 1000
const LONGEST = 15000

const decoder = new TextDecoder()

/**
 * Return the parts of a frame.
 * @param {ArrayBuffer} data
 * @returns {{head: Answer, block: ArrayBuffer, cells: ArrayBuffer}}
 */
export function decode(data) {
  const lengths = new DataView(data, 0, LENGTHS)
  const block = LENGTHS + lengths.getUint32(0, true)
  const cells = block + lengths.getUint32(4, true)
  const head = JSON.parse(decoder.decode(new Uint8Array(data, LENGTHS, block - LENGTHS)))
  return { head, block: data.slice(block, cells), cells: data.slice(cells) }
}

/**
 * Open the websocket and return the function that sends messages.
 * @param {(head: Answer, block: ArrayBuffer, cells: ArrayBuffer) => void} receive gets each answer
 * @param {(why: string) => void} lost is called when the connection is closed, with a reason if the server gave one
 * @returns {(message: StateRequest | {chart: ChartRequest}) => void}
 */
export function openWebsocket(receive, lost) {
  // The query names the first state; any worker can answer.
  const url = new URL(`states${location.search}`, document.baseURI)
  // The server names a part after "#" in a note, because it does not belong to a link.
  if (location.hash) url.searchParams.append(location.hash.split("=")[0], "")
  url.protocol = url.protocol.replace("http", "ws")
  const socket = new WebSocket(url)
  socket.binaryType = "arraybuffer"
  socket.addEventListener("message", ({ data }) => {
    const { head, block, cells } = decode(data)
    receive(head, block, cells)
  })
  socket.addEventListener("close", ({ code, reason }) => lost(code === FULL ? reason : ""))
  return (message) => socket.send(JSON.stringify(message))
}

/** Wait until the server answers; pauses are random, so that a class of browsers does not reconnect at once. */
export async function answering() {
  for (let pause = FIRST; ; pause = Math.min(2 * pause, LONGEST)) {
    await new Promise((done) => setTimeout(done, pause * (0.5 + Math.random())))
    const answer = await fetch(new URL("liveness", document.baseURI), { cache: "no-store" }).catch(() => /** @type {null} */ (null))
    if (answer?.ok) return
  }
}

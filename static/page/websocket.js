// The websocket by which states are asked for and come; "protocol/messages.py" describes the messages.

const LENGTHS = 8
// The code with which a server that has no room closes it.
const FULL = 1013

// Milliseconds between two questions whether a server is back that is gone: restarted, out of reach, or left behind while
// the machine slept.
const FIRST = 1000
const LONGEST = 15000

const decoder = new TextDecoder()

/**
 * @param {(head: object, block: ArrayBuffer, cells: ArrayBuffer) => void} receive - hears each answer
 * @param {(why: string) => void} lost - hears that the connection is gone, and why where that is no accident
 * @returns {(message: object) => void} sends a message
 */
export function openWebsocket(receive, lost) {
  // The query says what is shown first; which process answers is no matter.
  const url = new URL(`states${location.search}`, document.baseURI)
  url.protocol = url.protocol.replace("http", "ws")
  const socket = new WebSocket(url)
  socket.binaryType = "arraybuffer"
  socket.addEventListener("message", ({ data }) => {
    const lengths = new DataView(data, 0, LENGTHS)
    const block = LENGTHS + lengths.getUint32(0, true)
    const cells = block + lengths.getUint32(4, true)
    receive(JSON.parse(decoder.decode(new Uint8Array(data, LENGTHS, block - LENGTHS))), data.slice(block, cells), data.slice(cells))
  })
  socket.addEventListener("close", ({ code, reason }) => lost(code === FULL ? reason : ""))
  return (message) => socket.send(JSON.stringify(message))
}

// Resolves once it answers.  A class does not come back all at once.
export async function answering() {
  for (let pause = FIRST; ; pause = Math.min(2 * pause, LONGEST)) {
    await new Promise((done) => setTimeout(done, pause * (0.5 + Math.random())))
    const answer = await fetch(new URL("liveness", document.baseURI), { cache: "no-store" }).catch(() => null)
    if (answer?.ok) return
  }
}

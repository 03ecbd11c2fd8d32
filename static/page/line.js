// The line to the server, by which states are asked for and come; "page/desk.py" describes the frames.

const LENGTHS = 8
// The code with which a server that has no room ends the line.
const FULL = 1013

// take(head, block, cells) hears each answer; lost(sentence) that the line is gone, and why where that is no accident.
export function createLine({ take, lost }, signal) {
  // The query says what is shown first; which process answers is no matter.
  const url = new URL(`line${window.location.search}`, document.baseURI)
  url.protocol = url.protocol.replace("http", "ws")
  const socket = new WebSocket(url)
  socket.binaryType = "arraybuffer"
  const decoder = new TextDecoder()
  socket.addEventListener("message", ({ data }) => {
    const lengths = new DataView(data, 0, LENGTHS)
    const block = LENGTHS + lengths.getUint32(0, true)
    const cells = block + lengths.getUint32(4, true)
    take(JSON.parse(decoder.decode(new Uint8Array(data, LENGTHS, block - LENGTHS))), data.slice(block, cells), data.slice(cells))
  }, { signal })
  socket.addEventListener("close", ({ code, reason }) => lost(code === FULL ? reason : ""), { signal })
  signal.addEventListener("abort", () => socket.close())
  return { send(message) { socket.send(JSON.stringify(message)) } }
}

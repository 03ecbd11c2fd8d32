// A film that comes while it is made: the answer of the server says in lines before the file how far it is.

/**
 * Return the film out of an answer, see "server/export.py": {file} or {why}.
 * @param {Response} answer
 * @param {(frames: number[]) => void} count is told [done, of]
 */
export async function filmOf(answer, count) {
  const reader = answer.body.getReader()
  const parts = []
  let [begun, length, line] = [false, 0, []]
  for (;;) {
    const { value, done } = await reader.read()
    if (done) break
    let from = 0
    while (!begun) {
      const at = value.indexOf(10, from)
      line.push(...value.subarray(from, at < 0 ? value.length : at))
      if (at < 0) break
      const [word, ...rest] = new TextDecoder().decode(Uint8Array.from(line)).split(" ")
      ;[from, line] = [at + 1, []]
      if (word === "why") return { why: rest.join(" ") }
      if (word === "file") [begun, length] = [true, Number(rest[0])]
      else if (word !== "queued") count(word.split("/").map(Number))
    }
    if (begun) parts.push(value.subarray(from))
  }
  const file = new Blob(parts)
  return begun && file.size === length ? { file } : { why: "The film broke off: there is no file." }
}

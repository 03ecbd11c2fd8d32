// @ts-check
// A film or page that arrives while it is made: lines with its progress come before the file.

/**
 * Return the file in an answer, see "server/export.py", or the reason that there is none.
 * @param {Response} answer
 * @param {(parts: number[]) => void} count gets [done, of]
 * @returns {Promise<{file?: Blob, why?: string}>}
 */
export async function slowFileOf(answer, count) {
  const reader = answer.body.getReader()
  /** @type {Uint8Array<ArrayBuffer>[]} */
  const parts = []
  let [begun, length] = [false, 0]
  /** @type {number[]} */
  let line = []
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
  return begun && file.size === length ? { file } : { why: "The file is incomplete: nothing was saved." }
}

import assert from "node:assert/strict"
import test from "node:test"

import { slowFileOf } from "../../static/controls/slow_file.js"

// The film in an answer whose bytes come in pieces of `size`, and the counts that were told.
async function read(text, size) {
  const bytes = new TextEncoder().encode(text)
  const body = new ReadableStream({
    start(controller) {
      for (let i = 0; i < bytes.length; i += size) controller.enqueue(bytes.slice(i, i + size))
      controller.close()
    },
  })
  const counts = []
  const { file, why } = await slowFileOf(new Response(body), (count) => counts.push(count))
  return { counts, why, text: file && await file.text() }
}

test("the film follows its progress, however the bytes are cut", async () => {
  for (const size of [1, 3, 7, 100]) {
    assert.deepEqual(await read("queued\n1/3\n3/3\nfile 9\nfilm\nfilm", size), {
      counts: [[1, 3], [3, 3]], why: undefined, text: "film\nfilm",
    })
  }
})

test("a film that is refused or breaks off says why", async () => {
  assert.equal((await read("1/3\nwhy Nothing moves.\n", 4)).why, "Nothing moves.")
  for (const text of ["1/3\n", "file 9\nfilm"]) assert.match((await read(text, 5)).why, /incomplete/)
})

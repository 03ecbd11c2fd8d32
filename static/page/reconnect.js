// Waiting for a server that is gone: restarted, out of reach, or left behind while the machine slept.

const FIRST = 1000
const LONGEST = 15000

// Resolves once it answers.  A class does not come back all at once.
export async function answering() {
  for (let pause = FIRST; ; pause = Math.min(2 * pause, LONGEST)) {
    await new Promise((done) => setTimeout(done, pause * (0.5 + Math.random())))
    const answer = await fetch(new URL("liveness", document.baseURI), { cache: "no-store" }).catch(() => null)
    if (answer?.ok) return
  }
}

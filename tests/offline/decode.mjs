// Decodes a strip with the page's own module: argument 1 is the file, the result is JSON: for each state its sources with all
// columns as lists of numbers ("NaN" and "Infinity" as text).
import { readFileSync } from "node:fs"

import { decodeStrip } from "../../static/offline/strip.js"
import { unpack } from "../../static/base/unpack.js"

const strip = await decodeStrip(new Blob([readFileSync(process.argv[2])]).stream())
const list = (item) => {
  if (item instanceof Float32Array) return [...item].map((one) => (Number.isFinite(one) ? one : String(one)))
  if (Array.isArray(item)) return item.map(list)
  return typeof item === "object" && item !== null ? { ...item, numbers: list(item.numbers) } : item
}
console.log(JSON.stringify(strip.trees.map(({ sources, texts }) => {
  const columns = unpack(sources, strip.block).map(([name, each]) => (
    [name, Object.fromEntries(Object.entries(each).map(([key, item]) => [key, list(item)]))]))
  return { texts, sources: Object.fromEntries(columns) }
})))

// @ts-check
// The clouds of phase points on the Poisson sphere, as a guest of "sphere.js".

import { cloudsOf } from "./cloud.js"
import { pointLayer } from "./point_layer.js"

/**
 * Return the guest that draws clouds of points on a sphere.
 * @param {Source} source
 * @returns {SphereGuest}
 */
export function sphereClouds(source) {
  const clouds = cloudsOf(source)
  const layer = pointLayer()
  let t = 0
  return {
    /** @param {number} value */
    set t(value) { t = value },
    paint({ ctx, edge, ratio, px, py, depth }, near) {
      layer.draw(ctx, Math.round(edge * ratio), ratio, clouds.at(t), ({ count, g1, g2, g3 }, add) => {
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [g1[i], g2[i], g3[i]]
          if (depth(x, y, z) >= 0 === near) add(ratio * px(x, y), ratio * py(x, y, z))
        }
      })
    },
  }
}

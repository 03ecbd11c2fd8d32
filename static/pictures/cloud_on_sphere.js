// The clouds of phase points on the Poisson sphere, as a guest of "sphere.js".

import { cloudsOf } from "./cloud.js"
import { CLOUDS } from "./looks.js"
import { alphaOf, pointLayer, sideOf } from "./point_layer.js"

// paint(sheet, near) draws the half of the points that is near, or far, at the time t.
export function sphereClouds(source) {
  const clouds = cloudsOf(source)
  const layer = pointLayer()
  let t = 0
  return {
    set t(value) { t = value },
    paint({ ctx, size, ratio, px, py, depth }, near) {
      clouds.at(t).forEach((cloud, k) => {
        const { count, g1, g2, g3 } = cloud
        const [side, alpha] = [sideOf(ratio), alphaOf(cloud)]
        layer.begin(size, CLOUDS[k])
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [g1[i], g2[i], g3[i]]
          if (depth(x, y, z) >= 0 === near) layer.add(px(x, y), py(x, y, z), side, alpha)
        }
        layer.end(ctx)
      })
    },
  }
}

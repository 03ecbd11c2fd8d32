// @ts-check
// Media queries, the same as in the style sheets.

export const PHONE = matchMedia("(max-width: 799px), (max-height: 499px)")
// Controls and text share a column as tabs.
export const NARROW = matchMedia("(max-width: 1499px)")
export const CALM = matchMedia("(prefers-reduced-motion: reduce)")

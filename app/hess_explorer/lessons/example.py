"""The lesson that `hess-explorer lesson new` writes."""

from __future__ import annotations

EXAMPLE = r"""---
# The title in the menu, and about how long the lesson takes.
title: Two cycles are born
minutes: 5
---

Words before the first step are for you: the page does not show them.

Each heading with ## begins a step.  Its settings stand in a fence named step, one "name: value" per line.  Text
after # is a comment.  All settings but the first state may be left out.

Check the file with `hess-explorer lesson check FILE`.

## Before

```step
# The state of the page: set it by hand, press Share, and copy what follows the ? of the link.
state: "?scene=suslov-hess&h=0.5&f=0.6"
# The picture to enlarge.
look: circle
# With this line only these pictures are shown, over the text.
# pictures: [body, circle]
# The sliders beside the text.
controls: [h, f]
```

Text in Markdown: *emphasis*, **strong words**, lists, tables, and formulas like $a<b$ or, on a line of their own,

$$\dot u=-b'M_2\,u.$$

An image is a file beside this one, with a text alternative: `![A wheel](wheel.png)`.  A link may lead to
another web page, or [to a state of this one](?scene=suslov-hess&h=1.5&f=0.6).

### Question

Does the curve meet the diagonal?

### Answer

No: there is no cycle. The answer is shown on demand.

## Guess

```step
# A step without a state keeps that of the step before.
look: circle
# The audience clicks where it expects this layer of this picture; the state "then" shows it.
predict: {picture: circle, layer: stable, then: "?scene=suslov-hess&h=1.5&f=0.6"}
```

The energy rises from 0.5 to 1.5. Click where the stable cycle will be.

## The moment of birth

```step
state: "?scene=suslov-hess&h=0.5&f=0.6"
look: circle
# A parameter, or the time, that moves for so many seconds.
animate: {name: h, from: 0.5, to: 1.5, seconds: 10}
# A layer that is left out of a picture.
hide: {picture: circle, layer: density}
```

Call out when the curve touches the diagonal.
"""

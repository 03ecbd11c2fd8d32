"""Captions as text."""

from hess_explorer.views.caption import Caption


def as_text(caption):
    """The title, and below it verdict and numbers."""
    return "\n".join(filter(None, (caption.title, caption.words)))


def texts_in(tree):
    """All texts of a message to the browser by their keys, captions among them."""
    return {**tree["texts"], **{name: as_text(Caption(**parts)) for name, parts in tree["captions"].items()}}

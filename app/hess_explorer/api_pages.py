"""The pages of the Python packages, from their sources, which griffe reads without importing them.

So they can be made where a wheel is built, with none of what the packages import: `app/build_pages.py` loads this file
by its path.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path
from typing import Any

__all__ = ["MODULES", "pages"]

MODULES = {
    "hess_mechanics": "bodies, motions, sections, exponents, closed forms, proofs",
    "hess_explorer": "states of the explorer: data, pictures, code, notebooks",
    "hess_explorer.sweep": "a quantity over one to three parameters",
    "hess_explorer.library.state": "what a state can do",
    "hess_explorer.export.columns": "the columns of a picture",
}
"""Those whose `__all__` is written down, and what is in them."""

_STYLE = """
:root { color-scheme: light dark }
body { max-width: 52rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 system-ui, sans-serif }
pre { white-space: pre-wrap; font: .875rem/1.5 ui-monospace, monospace; margin: .25rem 0 1.5rem 1.5rem }
h2, h3 { font: 600 1rem/1.5 ui-monospace, monospace; margin: 1.5rem 0 0; overflow-wrap: anywhere }
h3 { margin-left: 1.5rem; font-weight: 500 } h3 + pre { margin-left: 3rem }
small { opacity: .75 } input { font: inherit; width: 100%; box-sizing: border-box; padding: .25rem .5rem }
li { margin: .25rem 0 }
"""
_SEARCH = """
const box = document.querySelector("input")
box.addEventListener("input", () => {
  const words = box.value.toLowerCase().split(/\\s+/)
  for (const item of document.querySelectorAll("li")) {
    item.hidden = !words.every((word) => item.textContent.toLowerCase().includes(word))
  }
})
"""


def pages(sources: Sequence[Path]) -> dict[str, str]:
    """Name of the file → HTML, from the folders that hold the packages.  Raises `ImportError` without griffe."""
    from griffe import GriffeLoader

    loader = GriffeLoader(search_paths=list(sources), allow_inspection=False)
    for package in dict.fromkeys(name.partition(".")[0] for name in MODULES):
        loader.load(package)
    loader.resolve_aliases(external=False)
    found = {name: loader.modules_collection[name] for name in MODULES}
    return {"index.html": _index(found)} | {f"{name}.html": _module(one) for name, one in found.items()}


def _public(module: Any) -> Iterator[tuple[str, Any]]:
    """What can be imported from it, by name."""
    for name in sorted(map(str, module.exports or ()), key=str.lower):
        one = module[name]
        yield name, one.final_target if one.is_alias else one


def _words(one: Any) -> str:
    return str(one.docstring.value) if one.docstring else ""


def _signature(name: str, one: Any) -> str:
    if one.is_function or one.is_class:
        # With the name under which it is imported.
        return name + str(one.signature()).removeprefix(one.name)
    return f"{name}: {one.annotation}" if one.is_attribute and one.annotation else name


def _module(module: Any) -> str:
    parts = [f"<p><a href='index.html'>All</a></p><h1>{escape(module.path)}</h1><pre>{escape(_words(module))}</pre>"]
    for name, one in _public(module):
        parts.append(
            f"<h2 id='{escape(name)}'>{escape(_signature(name, one))}</h2>"
            f"<small>{escape(one.canonical_path)}</small><pre>{escape(_words(one))}</pre>"
        )
        if one.is_class:
            parts += [
                f"<h3 id='{escape(name)}.{escape(key)}'>{escape(_signature(key, member))}</h3>"
                f"<pre>{escape(_words(member))}</pre>"
                for key, member in one.members.items()
                if not key.startswith("_") and not member.is_alias and member.docstring
            ]
    return _page(module.path, "".join(parts))


def _index(found: dict[str, Any]) -> str:
    parts = [
        "<h1>Hess Explorer from Python</h1><input type='search' aria-label='Search' placeholder='Search' autofocus>"
    ]
    for path, module in found.items():
        items = "".join(
            f"<li><a href='{path}.html#{escape(name)}'><code>{escape(name)}</code></a> "
            f"{escape(_words(one).partition(chr(10))[0])}</li>"
            for name, one in _public(module)
        )
        parts.append(f"<h2><a href='{path}.html'>{path}</a></h2><p>{MODULES[path].capitalize()}.</p><ul>{items}</ul>")
    return _page("Hess Explorer from Python", "".join(parts) + f"<script>{_SEARCH}</script>")


def _page(title: str, body: str) -> str:
    return (
        f"<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
        f"<title>{escape(title)}</title><style>{_STYLE}</style><main>{body}</main></html>"
    )

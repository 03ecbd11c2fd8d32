"""Modules of the page in one file: a browser needs half a second to load a hundred files."""

from __future__ import annotations

import posixpath
import re
from functools import cache

from hess_explorer.assets import STATIC

# These are the only forms in the modules; any other form makes the bundle a syntax error.
_IMPORT = re.compile(r'^import \{([^}]*)\} from "(\.{1,2}/[\w./]+\.js)"$', re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?(?:function|const|class)) (\w+)", re.MULTILINE)


@cache
def bundle(entry: str) -> str:
    """Bundle a module with all modules that it imports.

    Each module becomes a function that is called once, after those of its imports, and returns its exports.

    Parameters
    ----------
    entry : str
        Path of a module in `STATIC`.

    Returns
    -------
    str
        The code.  It exports what `entry` exports, and the exports of each module under its path.
    """
    exports: dict[str, str] = {}
    parts: dict[str, str] = {}

    def add(path: str) -> str:
        name = _name(path)
        if path not in exports:
            source = (STATIC / path).read_text(encoding="utf-8")
            exports[path] = ", ".join(found[1] for found in _EXPORT.findall(source))
            # A module follows its imports, which this substitution adds first.
            code = _IMPORT.sub(lambda found: _constants(found[1], add(_resolve(path, found[2]))), source)
            body = _EXPORT.sub(r"\1 \2", code)
            parts[path] = f"// {path}\nconst {name} = (() => {{\n{body}\nreturn {{ {exports[path]} }}\n}})()\n"
        return name

    last = add(entry)
    names = ", ".join(f'{_name(path)} as "{path}"' for path in parts)
    return "".join(parts.values()) + f"export const {{ {exports[entry]} }} = {last}\nexport {{ {names} }}\n"


def _name(path: str) -> str:
    return re.sub(r"\W", "_", path.removesuffix(".js"))


def _constants(names: str, module: str) -> str:
    return f"const {{{names.replace(' as ', ': ')}}} = {module}"


def _resolve(path: str, other: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(path), other))

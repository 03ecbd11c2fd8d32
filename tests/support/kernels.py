"""Compiled kernels handed to another copy of the package, or another cache folder, so that it need not compile."""

import hashlib
import shutil
from pathlib import Path

import hess_mechanics
from hess_mechanics.numerics.jit import CACHE_FOLDER


def copy_kernels(base, package=None):
    """Copy the kernels of this copy of `hess_mechanics` for the one at `package` (default: this one) below `base`.

    base : its NUMBA_CACHE_DIR.  Numba files kernels under a hash of the folder of their source, and takes them only
    for the very same source; a layout unknown here costs time and nothing else.
    """
    here = Path(hess_mechanics.__file__).parent
    there = Path(package) if package is not None else here
    cache = Path(base) / CACHE_FOLDER.name
    cache.mkdir(mode=0o700, parents=True)
    pairs = [(here, there)]
    pairs += [(path, there / path.relative_to(here)) for path in here.rglob("*") if path.is_dir()]
    # Derived source stands in the cache itself.
    pairs += [(path, cache / path.name) for path in CACHE_FOLDER.iterdir() if path.is_dir()]
    names = {_filed(old): _filed(new) for old, new in pairs}
    for folder in CACHE_FOLDER.rglob("*"):
        if folder.is_dir() and folder.name in names:
            shutil.copytree(folder, cache / folder.relative_to(CACHE_FOLDER).with_name(names[folder.name]))


def _filed(folder):
    """The name under which Numba files the kernels of a folder."""
    return f"{folder.name}_{hashlib.sha1(str(folder).encode()).hexdigest()}"

"""Validate the docstrings of all public names by numpydoc, with the checks of `pyproject.toml`.

Public are the names in `__all__` of the packages below, all names without an underscore in the modules of the
mechanics, and the public methods and properties of these classes.  Modules whose docstring says "Not for users.", as
those of kernels do, are left out.  A class documents its fields as Parameters, or as Attributes where its users do not
construct it.  Functions of a package also need Examples.
"""

from __future__ import annotations

import functools
import importlib
import inspect
import pkgutil
import re
import sys
import tomllib
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from numpydoc.docscrape import get_doc_object
from numpydoc.validate import Validator, validate

PACKAGES = ("hess_mechanics", "hess_explorer", "hess_explorer.sweep")
WALKED = "hess_mechanics"
INTERNAL = "Not for users."
CONFIGURATION = Path(__file__).parents[1] / "pyproject.toml"
MEMBERS = (FunctionType, property, classmethod, functools.cached_property)
OPENING = re.compile(r"(What|Whether|Who|Whose|Of|How|Where|Which)\b")


class Documented(Validator):  # type: ignore[misc]  # numpydoc has no types
    """The validator of numpydoc, for which Attributes document the fields of a class too."""

    def __init__(self, obj_name: str) -> None:
        super().__init__(get_doc_object(self._load_obj(obj_name)))

    @property
    def parameter_mismatches(self) -> list[Any]:
        """Errors in the names or the order of the parameters or fields."""
        if inspect.isclass(self.obj) and (issubclass(self.obj, Enum) or getattr(self.obj, "_is_protocol", False)):
            return []  # Users do not call these methods.
        fields = {name for name in self.signature_parameters if not name.startswith("_")}
        if not inspect.isclass(self.obj) or (fields and not self.doc["Attributes"]):
            return list(super().parameter_mismatches)
        missing = fields - set(self._doc_parameters(["Parameters", "Attributes"]))
        return [("PR01", f"Fields {missing} not documented")] if missing else []


def modules() -> Iterator[ModuleType]:
    """Yield the packages, and all modules of the mechanics that are for users."""
    yield from map(importlib.import_module, PACKAGES)
    root = importlib.import_module(WALKED)
    for found in pkgutil.walk_packages(root.__path__, f"{WALKED}."):
        module = importlib.import_module(found.name)
        if INTERNAL not in (module.__doc__ or ""):
            yield module


def names_of(module: ModuleType) -> Iterator[str]:
    """Yield the names in `__all__`, and those without an underscore that the module defines."""
    own = [name for name, value in vars(module).items() if getattr(value, "__module__", "") == module.__name__]
    yield from dict.fromkeys([*getattr(module, "__all__", ()), *(name for name in own if not name.startswith("_"))])


def public_names() -> Iterator[str]:
    """Yield the full names of all public functions and classes, and of the methods and properties that these define.

    A name is yielded once, from the first module that has it; a member from the class that defines it.
    """
    seen: set[int] = set()
    for module in modules():
        for name in names_of(module):
            found = getattr(module, name)
            plain = inspect.unwrap(found) if callable(found) else found
            if not (inspect.isfunction(plain) or inspect.isclass(plain)) or not plain.__module__.startswith(PACKAGES):
                continue
            if id(found) in seen:
                continue
            seen.add(id(found))
            yield f"{module.__name__}.{name}"
            for base in getattr(found, "__mro__", ()):
                for member, value in vars(base).items() if base.__module__.startswith(PACKAGES) else ():
                    # The default value of a field, which is documented with its class.
                    is_field = getattr(value, "__name__", "") == "<lambda>"
                    if (
                        not (member.startswith("_") or is_field)
                        and isinstance(value, MEMBERS)
                        and id(value) not in seen
                    ):
                        seen.add(id(value))
                        yield f"{base.__module__}.{base.__qualname__}.{member}"


def errors_of(name: str, ignored: set[str]) -> list[str]:
    """Return the errors in the docstring of a public name, as "code: message"."""
    found = validate(name, Documented)
    errors = [f"{code}: {message}" for code, message in found["errors"] if code not in ignored]
    if found["type"] == "function" and name.rpartition(".")[0] in PACKAGES and ">>>" not in found["docstring"]:
        errors.append("EX01: No examples")
    if OPENING.match(found["docstring"]):
        errors.append("SS: The summary begins with a clause; say what is returned or done")
    return errors


def main() -> int:
    """Print all errors, and return 1 where there are any."""
    checks = tomllib.loads(CONFIGURATION.read_text(encoding="utf-8"))["tool"]["numpydoc_validation"]["checks"]
    wrong = {name: errors for name in public_names() if (errors := errors_of(name, set(checks[1:])))}
    for name, errors in wrong.items():
        print(name, *errors, sep="\n    ")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())

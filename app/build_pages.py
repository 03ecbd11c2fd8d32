"""Build hook: the wheel has the pages of the packages, made from their sources; see `hess_explorer.api_pages`."""

import runpy
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PagesHook(BuildHookInterface[Any]):
    """An installation that is edited has none: `hess-explorer docs` makes them anew there."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the pages, and have them packed."""
        if version == "editable":
            return
        root = Path(self.root)
        made = runpy.run_path(str(root / "app/hess_explorer/api_pages.py"))["pages"]([root / "app", root / "models"])
        # The builder packs it after this hook has ended.
        self._folder = tempfile.TemporaryDirectory()
        for name, text in made.items():
            file = Path(self._folder.name) / name
            file.write_text(text, encoding="utf-8")
            build_data["force_include"][str(file)] = f"hess_explorer/pages/{name}"

"""The text above a picture."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Caption:
    """The text above a picture: title and verdict on one line, the numbers below.

    Parameters
    ----------
    verdict : str
        Main result in at most eight words.
    numbers : str
        Numbers that support it.
    title : str
        Heading of two to five words; `Picture.full_caption` fills in the title of the picture.
    """

    verdict: str = ""
    numbers: str = ""
    title: str = ""

    @property
    def words(self) -> str:
        """Verdict and numbers as one string, for metadata and other single-line uses."""
        return " ".join(filter(None, (self.verdict, self.numbers)))

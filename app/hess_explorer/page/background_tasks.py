"""The background tasks of the current state."""

from __future__ import annotations

from typing import Any

from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import Report


class BackgroundTasks:
    """Starts, stops and reports the background tasks of the current state.

    Attributes
    ----------
    background : Background
        Computes the tasks.
    progress : tuple of int or None
        Numbers (done, total) while tasks are running, otherwise None.
    """

    def __init__(self) -> None:
        self.background = Background()
        self.progress: tuple[int, int] | None = None
        self._followed: set[Task[Any]] = set()
        self._next: list[Task[Any]] | None = None
        self._adds = False
        self._left = 0
        self._stopped = False

    def stop(self) -> None:
        """Stop the tasks and keep the drawn results, until another state is requested."""
        if self.progress is not None:
            self._stopped = True
            self._next = None
            self.background.stop()

    def drop(self) -> None:
        """Discard the tasks of the current state."""
        self.progress = None
        self._next = None
        self.background.stop()

    def cancel_running(self) -> None:
        """End the running tasks, which would slow down another state, and allow tasks again."""
        self._stopped = False
        self.background.stop()

    def is_done(self, more: bool) -> bool:
        """Return whether no task is left, if `more`; otherwise whether `stop` has ended the tasks.

        Call this before the state is computed, because the last task may end during that computation.

        Parameters
        ----------
        more : bool
            True if the state is drawn again with new results of its tasks.

        Returns
        -------
        bool
            True if the tasks have ended.
        """
        self._left = self.background.backlog
        return self._left == 0 if more else self._stopped

    @property
    def has_updates(self) -> bool:
        """True if a task has ended since the state was computed, or none is left; False if tasks wait for `start`."""
        return self._next is None and not 0 < self.background.backlog == self._left

    def follow(self, report: Report, more: bool, ended: bool) -> list[str]:
        """Plan the tasks of a report, which `start` starts, and return notes if they ended early.

        Parameters
        ----------
        report : Report
            Report of the drawn state.
        more, ended : bool
            Argument and result of `is_done`.

        Returns
        -------
        list of str
            One note with the error, or with the number of drawn parts; empty if nothing is missing or tasks follow.
        """
        left = len(report.todo)
        if not more:
            self._followed = set()
        # A result may create further tasks.
        fresh = [task for task in report.todo if task not in self._followed]
        # After a stop, a picture that enters the viewport does not start tasks again.
        if not self._stopped and (not more or (fresh and not self.background.error)):
            self._followed.update(fresh)
            self._adds = more
            self._left = len(fresh) + (self._left if more else 0)
            self._next = fresh
            ended = False
        elif not more:
            self._next = []
        self.progress = (report.total - left, report.total) if left and not ended else None
        if not (left and ended):
            return []
        return [
            self.background.error
            or (f"Stopped: {report.total - left} of {report.total} parts are drawn. Change a value to compute again.")
        ]

    def start(self) -> None:
        """Start the planned tasks, if any."""
        if self._next is not None:
            (self.background.add if self._adds else self.background.follow)(self._next)
            self._next = None

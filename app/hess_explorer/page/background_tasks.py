"""The tasks that a state still lacks: computed in the background until they are stopped."""

from __future__ import annotations

from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import Report

__all__ = ["BackgroundTasks"]


class BackgroundTasks:
    """The tasks of the state on show.

    background : computes them; progress : (done, of) while some are on their way.
    """

    def __init__(self) -> None:
        self.background = Background()
        self.progress: tuple[int, int] | None = None
        self._followed: set[Task] = set()
        self._next: list[Task] | None = None
        self._left = 0
        self._stopped = False

    def stop(self) -> None:
        """Leave it at what is drawn, until something else is wanted."""
        if self.progress is not None:
            self._stopped = True
            self.background.stop()

    def drop(self) -> None:
        """Nothing of the state on show is of use."""
        self.progress = None
        self._next = None
        self.background.stop()

    def resume(self) -> None:
        """Something else is wanted."""
        self._stopped = False

    def ended(self, more: bool) -> bool:
        """Whether nothing is computed any more; more : whether the state is the same.

        To be asked before the state is computed: the last task may end meanwhile.
        """
        self._left = self.background.left
        return self._left == 0 if more else self._stopped

    @property
    def news(self) -> bool:
        """Return whether a task has ended since the state was computed, or none is running."""
        return not 0 < self.background.left == self._left

    def follow(self, report: Report, more: bool, ended: bool) -> list[str]:
        """What the report lacks is computed in the background from `start` on; a note where that had ended early."""
        left = len(report.todo)
        if not more:
            self._followed = set()
        # What was found may ask for more.
        fresh = [task for task in report.todo if task not in self._followed]
        # Once stopped, a picture that comes into sight begins nothing again.
        if not self._stopped and (not more or (ended and fresh and not self.background.error)):
            self._followed.update(fresh)
            self._left = len(fresh)
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
        """Start the tasks, once the answer has been sent: they would hold it up while they have Python's lock."""
        if self._next is not None:
            self.background.follow(self._next)
            self._next = None

"""Who listens to long calls."""

import functools
import os
import threading


class _Bar:
    """A bar by tqdm, shown on terminals only."""

    def __init__(self, tqdm):
        self._tqdm = tqdm
        self._bar = None
        self._task = None

    def __call__(self, task, done, total, unit):
        if task != self._task:
            self.close()
            self._task = task
            self._bar = self._tqdm(desc=task, total=total, unit=" " + unit, leave=False, disable=None, bar_format="{l_bar}{bar}| {n:.1f}/{total:.0f}{unit} [{elapsed}<{remaining}]")
        self._bar.update(done - self._bar.n)

    def close(self):
        if self._bar is not None:
            self._bar.close()
        self._bar = self._task = None


@functools.cache
def _tqdm():
    """The class of tqdm's bars, None where it is not installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm


# An import holds locks that a child which is forked off meanwhile would find taken for ever: tqdm is looked for once,
# and forks wait for that.
_looking = threading.RLock()
os.register_at_fork(before=_looking.acquire, after_in_parent=_looking.release, after_in_child=_looking.release)


def listener(progress):
    """The callable (task, done, total, unit) that `progress` asks for, or None for silence."""
    if progress is False:
        return None
    if progress is not None and progress is not True:
        return progress
    with _looking:
        tqdm = _tqdm()
    return None if tqdm is None else _Bar(tqdm)

"""Figures: data, pictures, and axes of matplotlib."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _trackdyn, _values
from ._errors import OutputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Figure:
    """A figure as a value: panels with axes and series, which is drawn only when asked for."""

    __slots__ = ("_inner",)
    _inner: _trackdyn.Figure

    def __init__(self, inner: _trackdyn.Figure) -> None:
        self._inner = inner

    @property
    def name(self) -> str:
        """Name of its file, without the ending."""
        return self._inner.name

    @property
    def title(self) -> str:
        """What it shows."""
        return self._inner.title

    @property
    def reading(self) -> str:
        """How to read it."""
        return self._inner.reading

    @property
    def data(self) -> dict[str, Any]:
        """All that is shown, as dicts and lists: panels with axes and series in their own units."""
        return self._inner.data()

    def to_png(self) -> bytes:
        """The picture as PNG."""
        return self._inner.to_png()

    def to_svg(self) -> str:
        """The picture as SVG."""
        return self._inner.to_svg()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture.

        Parameters
        ----------
        path : str or path
            SVG where it ends so, else PNG.
        """
        place = Path(_values.path("path", path))
        is_svg = place.suffix == ".svg"
        picture = self.to_svg().encode() if is_svg else self.to_png()
        try:
            place.write_bytes(picture)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise OutputError(f"{place}: cannot be written: {reason}") from None

    def plot(self, panel: int = 0, ax: Axes | None = None) -> Axes:
        """Draw the series of a panel on axes of matplotlib, which has to be installed.

        Parameters
        ----------
        panel : int
            Which of the panels of :attr:`data`.
        ax : matplotlib axes, optional
            Default: the current ones.

        Returns
        -------
        matplotlib axes
            Those that were drawn on.
        """
        from ._axes import draw

        panels = self.data["panels"]
        if _values.whole("panel", panel) not in range(-len(panels), len(panels)):
            raise _values.refused("panel", panel, f"0 to {len(panels) - 1}")
        if ax is not None and not hasattr(ax, "set_xlim"):
            raise _values.refused("ax", ax, "axes of matplotlib")
        return draw(panels[_values.whole("panel", panel)], ax)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.data,)

    def __copy__(self) -> Figure:
        return Figure(self._inner)

    def __deepcopy__(self, memo: dict[int, Any]) -> Figure:
        # nothing of what is shared can be changed
        return self.__copy__()

    def _repr_png_(self) -> bytes:
        return self.to_png()

    def __repr__(self) -> str:
        return f"<Figure {self.name}: {self.title}>"


def _restored(data: dict[str, Any]) -> Figure:
    """A figure from a pickle."""
    return Figure(_trackdyn.Figure.restore(data))

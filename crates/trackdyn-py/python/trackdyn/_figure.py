"""Figures: data, pictures, and axes of matplotlib."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _trackdyn

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
        """Write the picture: SVG where the path ends so, else PNG."""
        if Path(path).suffix == ".svg":
            Path(path).write_text(self.to_svg(), encoding="utf-8")
        else:
            Path(path).write_bytes(self.to_png())

    def plot(self, panel: int = 0, ax: Axes | None = None) -> Axes:
        """Draw the series of a panel on axes of matplotlib, which has to be installed.

        Parameters
        ----------
        panel : int
            Which of the panels of :attr:`data`.
        ax : matplotlib axes, optional
            Default: the current ones.
        """
        from ._axes import draw

        return draw(self.data["panels"][panel], ax)

    def _repr_png_(self) -> bytes:
        return self.to_png()

    def __repr__(self) -> str:
        return f"<Figure {self.name}: {self.title}>"

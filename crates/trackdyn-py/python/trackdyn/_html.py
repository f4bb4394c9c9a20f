"""Small pages for notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table."""
    heads = "".join(f"<th style='text-align:left'>{escape(text)}</th>" for text in head)
    lines = "".join(
        "<tr>" + "".join(f"<td style='text-align:left'>{_cell(one)}</td>" for one in row) + "</tr>"
        for row in rows
    )
    top = f"<thead><tr>{heads}</tr></thead>" if head else ""
    return f"<table>{top}<tbody>{lines}</tbody></table>"


def page(title: str, rows: Iterable[tuple[str, object]], notes: Iterable[str] = ()) -> str:
    """A title, a table of what is known, and notes."""
    items = "".join(f"<li>{escape(note)}</li>" for note in notes)
    below = f"<ul>{items}</ul>" if items else ""
    return f"<div><b>{escape(title)}</b>{table((), rows)}{below}</div>"


def _cell(value: object) -> str:
    if isinstance(value, float):
        return escape(f"{value:.6g}")
    if isinstance(value, (list, tuple)):
        return escape(", ".join(map(str, value)))
    return escape("" if value is None else str(value))

"""Panels of figures on axes of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw(panel: dict[str, Any], ax: Axes | None) -> Axes:
    """Draw the series of a panel in its own units."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.gca()
    # cells fill the panel, so its ranges come first
    ax.set_xlim(panel["x"]["range"])
    ax.set_ylim(panel["y"]["range"])
    for series in panel["series"]:
        sign = dict(series["sign"])
        _KINDS[sign.pop("kind")](ax, sign, series["name"] or None)
    ax.set_title(panel["title"])
    for axis, name in ((ax.xaxis, "x"), (ax.yaxis, "y")):
        of = panel[name]
        unit = f" ({of['unit']})" if of["unit"] else ""
        axis.set_label_text(f"{of['quantity']}{unit}" if of["is_labelled"] else "")
        if of["ticks"] != "round":
            places = of["ticks"]["at"]
            axis.set_ticks([at for at, _ in places], labels=[text for _, text in places])
    ax.set_xlim(panel["x"]["range"])
    ax.set_ylim(panel["y"]["range"])
    for label in panel["labels"]:
        _label(ax, label)
    _explain(ax, panel["title"])
    return ax


def _explain(ax: Any, title: str) -> None:
    """A legend of the named series, where more than the title names them."""
    handles, names = ax.get_legend_handles_labels()
    # series of one name look alike: the last one stands for them
    named = {name: handle for handle, name in zip(handles, names) if name != title}
    if len(named) > 1:
        ax.legend(named.values(), named.keys(), fontsize="small")


def _label(ax: Any, label: dict[str, Any]) -> None:
    across, up = label["style"]["anchor"]
    # sheets are drawn at about 200 pixels per inch, downwards
    right, down = (0.36 * pixels for pixels in label["shift"])
    ax.annotate(
        label["text"],
        label["at"],
        (right, -down),
        textcoords="offset points",
        annotation_clip=False,
        ha={"centre": "center"}.get(across, across),
        va={"middle": "center"}.get(up, up),
        rotation=90 if label["style"]["upwards"] else 0,
        color=_colour(label["style"]["colour"]),
        fontsize=0.32 * label["style"]["size"],
    )


def _colour(rgb: Any) -> tuple[float, ...]:
    return tuple(channel / 255.0 for channel in rgb)


def _points(points: Any) -> Any:
    return np.asarray(points, dtype=np.float64).reshape(-1, 2)


def _paint(paint: dict[str, Any]) -> dict[str, Any]:
    """Keywords of a scatter for a paint."""
    if "one" in paint:
        return {"color": [_colour(paint["one"])]}
    if "each" in paint:
        return {"color": [_colour(rgb) for rgb in paint["each"]]}
    return _scaled(paint["values"]["values"], paint["values"]["scale"])


def _scaled(values: Any, scale: dict[str, Any]) -> dict[str, Any]:
    from matplotlib.colors import LinearSegmentedColormap

    anchors = [_colour(rgb) for rgb in scale["colours"]["anchors"]]
    low, high = scale["range"]
    cmap = LinearSegmentedColormap.from_list("trackdyn", anchors)
    return {"c": values, "cmap": cmap, "vmin": low, "vmax": high}


def _line(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    points = _points(sign["points"])
    width = sign["thickness"] / 2.0
    ax.plot(points[:, 0], points[:, 1], color=_colour(sign["colour"]), lw=width, label=name)


def _rule(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    rule = ax.axhline if sign["is_level"] else ax.axvline
    style = "--" if sign["is_dashed"] else "-"
    width = sign["thickness"] / 2.0
    rule(sign["at"], color=_colour(sign["colour"]), lw=width, ls=style, label=name)


def _arrow(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    (x, y), (across, up) = sign["from"], sign["by"]
    ax.annotate(
        "",
        (x + across, y + up),
        (x, y),
        arrowprops={"arrowstyle": "->", "color": _colour(sign["colour"])},
    )


def _marks(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    points = _points(sign["points"])
    shape = sign["shape"]
    marker = "s" if shape in ("square", "open_square") else "o"
    ax.scatter(points[:, 0], points[:, 1], s=16, marker=marker, label=name, **_paint(sign["paint"]))


def _estimates(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    points = _points(sign["points"])
    value = points[:, 0] if sign["is_across"] else points[:, 1]
    ends = [(at, at) if of is None else of for at, of in zip(value, sign["intervals"])]
    lengths = np.abs(np.asarray(ends, dtype=np.float64).reshape(-1, 2).T - value)
    errors = {"xerr" if sign["is_across"] else "yerr": lengths}
    style = "-" if sign["joined"] is not None else "none"
    colour = _colour(sign["colour"])
    marker = None if sign["shape"] is None else "o"
    ax.errorbar(
        points[:, 0], points[:, 1], color=colour, ls=style, marker=marker, ms=4, label=name, **errors
    )


def _boxes(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    def box(corners: Any) -> Any:
        (x, y), (right, top) = corners
        return Rectangle((x, y), right - x, top - y)

    patches = [box(corners) for corners in sign["boxes"]]
    edge = "none" if sign["edge"] is None else _colour(sign["edge"][1])
    collection = PatchCollection(patches, edgecolor=edge, label=name)
    if sign["paint"] is None:
        collection.set_facecolor("none")
    else:
        paint = _paint(sign["paint"])
        if "c" in paint:
            collection.set_array(np.asarray(paint["c"]))
            collection.set_cmap(paint["cmap"])
            collection.set_clim(paint["vmin"], paint["vmax"])
        else:
            collection.set_facecolor(paint["color"])
    ax.add_collection(collection)


def _cells(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    cells = [one["value"] if "value" in one else np.nan for one in sign["cells"]]
    # upwards, column by column
    table = np.asarray(cells, dtype=np.float64).reshape(sign["count"], -1).T
    paint = _scaled(table, sign["scale"])
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    x = np.linspace(left, right, table.shape[1] + 1)
    y = np.linspace(low, high, table.shape[0] + 1)
    mesh = ax.pcolormesh(x, y, table, cmap=paint["cmap"])
    mesh.set_clim(paint["vmin"], paint["vmax"])


def _cloud(ax: Any, sign: dict[str, Any], name: str | None) -> None:
    points = _points(sign["points"])
    ax.scatter(
        points[:, 0], points[:, 1], s=4, label=name, **_scaled(sign["values"], sign["scale"])
    )


_KINDS = {
    "line": _line,
    "rule": _rule,
    "arrow": _arrow,
    "points": _marks,
    "estimates": _estimates,
    "boxes": _boxes,
    "cells": _cells,
    "cloud": _cloud,
}

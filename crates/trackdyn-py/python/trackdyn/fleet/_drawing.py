"""Trends as a picture: steering efficiencies over time, and the drift of each robot."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ._trends import RobotTrend, Trends

#: Colours of robots that are named, which the colour-blind tell apart (Okabe and Ito).
_COLOURS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
_MARKERS = "osD^vP"
_GREY = "0.65"

#: Robots that have room in the right panel: those with the surest drift.
_MAX_ROBOTS = 40


def draw(of: Trends, figure: Figure | None) -> Figure:
    """Draw on a figure of matplotlib."""
    shown = sorted(of.robots, key=_rank)[:_MAX_ROBOTS]
    if figure is None:
        import matplotlib.pyplot as plt

        height = max(4.5, 1.5 + 0.22 * len(shown))
        figure = plt.figure(figsize=(12.0, height), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    ranked = sorted(of.robots, key=_rank)
    # a few robots have colours in any case
    is_small = len(ranked) <= len(_COLOURS)
    named = [robot for robot in ranked if is_small or _is_named(robot)]
    styles = {
        robot.robot: (_COLOURS[place], _MARKERS[place])
        for place, robot in enumerate(named[: len(_COLOURS)])
    }
    _over_time(left, of, styles, "the others" if styles else "all robots")
    _drifts(right, of, shown, styles)
    return figure


def _over_time(ax: Any, of: Trends, styles: dict[str, tuple[str, str]], rest: str) -> None:
    is_told = False
    for robot in sorted(of.robots, key=lambda one: one.robot in styles):
        at = [of.epoch + timedelta(days=float(t)) for t in robot.t] if of.epoch else robot.t
        colour, marker = styles.get(robot.robot, (_GREY, "."))
        is_other = robot.robot not in styles
        label = None if is_other and is_told else rest if is_other else robot.robot
        is_told = is_told or is_other
        ax.errorbar(
            at,
            robot.chi,
            1.96 * robot.chi_se,
            color=colour,
            marker=marker,
            ms=3 if is_other else 5,
            ls="none",
            lw=0.6 if is_other else 1.0,
            alpha=0.5 if is_other else 1.0,
            label=label,
        )
        # too few logs have no line
        if not is_other and np.isfinite(robot.drift.value):
            line = robot.line.level + robot.line.slope * (robot.t - robot.t.mean())
            ax.plot(at, line, color=colour, lw=1.5)
    ax.set_title("Steering efficiency of each log")
    ax.set_ylabel("steering efficiency χ (1), bars 95 %")
    ax.set_xlabel("begin of the log (UTC)")
    ax.tick_params(axis="x", rotation=30)
    ax.legend(fontsize="small")


def _drifts(
    ax: Any, of: Trends, shown: list[RobotTrend], styles: dict[str, tuple[str, str]]
) -> None:
    for place, robot in enumerate(shown):
        found = robot.drift
        colour, marker = styles.get(robot.robot, (_GREY, "o"))
        if np.isfinite(found.value):
            half = (found.high - found.low) / 2.0
            ax.errorbar(found.value, place, xerr=half, color=colour, marker=marker, ms=4)
        else:
            text = f"cannot tell: {len(robot.t)} logs"
            inside = ax.get_yaxis_transform()
            ax.text(0.02, place, text, fontsize="small", va="center", transform=inside)
    level = float(np.median([robot.line.level for robot in of.robots]))
    band = of.matters * level
    ax.axvspan(-band, band, color="0.92", zorder=0, label=f"less than {100 * of.matters:g} % of χ")
    ax.axvline(0.0, color="0.3", lw=0.8)
    ax.set_yticks(range(len(shown)), [_label(robot) for robot in shown], fontsize="small")
    # room for the legend below
    ax.set_ylim(len(shown) + 0.7, -0.7)
    ax.set_xlabel("change of χ from first to last log (1), bars 95 %")
    count = f", {len(shown)} of {len(of.robots)} robots" if len(shown) < len(of.robots) else ""
    ax.set_title(f"Drift{count}")
    ax.legend(fontsize="small", loc="lower right")


def _label(robot: RobotTrend) -> str:
    signs = [
        word
        for word, found in (
            ("drifts", robot.drift),
            ("beside siblings", robot.drift_beside),
            ("differs", robot.difference),
        )
        if found.verdict == "yes"
    ]
    return f"{robot.robot}: {', '.join(signs)}" if signs else robot.robot


def _is_named(robot: RobotTrend) -> bool:
    return any(one.verdict == "yes" for one in (robot.drift, robot.drift_beside, robot.difference))


def _rank(robot: RobotTrend) -> tuple[bool, float, str]:
    """Robots that are named first, then by the probability of their drift."""
    p = robot.drift.p if np.isfinite(robot.drift.p) else 1.0
    return not _is_named(robot), p, robot.robot

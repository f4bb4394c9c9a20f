"""Trends in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._judged import Finding
    from ._trends import RobotTrend, Trends

_QUESTIONS = (
    ("drift", "drifts away from its own past", "chi changed by"),
    ("drift_beside", "drifts away from its siblings", "chi changed beside theirs by"),
    ("difference", "differs from its siblings", "chi away from theirs by"),
)


def said(of: Trends) -> str:
    """What was found, what was not, and what cannot be told."""
    logs = sum(len(robot.t) for robot in of.robots)
    lines = [f"{len(of.robots)} robots, {logs} logs"]
    for name, words, by in _QUESTIONS:
        findings = [(robot, _finding(robot, name)) for robot in of.robots]
        for robot, found in findings:
            if found.verdict == "yes":
                value = f"{found.value:+.4f} [{found.low:+.4f}, {found.high:+.4f}]"
                lines.append(f"{robot.robot} {words}: {by} {value}, q = {found.q:.2g}")
        lines.append(f"{words}: {_count([found for _, found in findings])}")
    for claim in of.claims:
        if claim.appeared.verdict == "yes":
            since = f"{claim.first:%Y-%m-%d}"
            share = f"{claim.claimed} of {claim.logs} logs"
            lines.append(
                f"{claim.robot}: {_short(claim.effect)} appeared: {share}, the first on {since}, "
                f"q = {claim.appeared.q:.2g}"
            )
    lines.append(f"claim that appeared: {_count([claim.appeared for claim in of.claims])}")
    return "\n".join([*lines, *of.notes])


def _short(effect: str) -> str:
    """Several effects that go together, without more than three names."""
    names = effect.split(" or ")
    return effect if len(names) <= 3 else f"{' or '.join(names[:2])} or {len(names) - 2} others"


def _finding(of: RobotTrend, name: str) -> Finding:
    finding: Finding = getattr(of, name)
    return finding


def _count(findings: list[Finding]) -> str:
    counts = {word: 0 for word in ("yes", "no", "cannot tell")}
    for one in findings:
        counts[one.verdict] += 1
    return ", ".join(f"{word} {count}" for word, count in counts.items())

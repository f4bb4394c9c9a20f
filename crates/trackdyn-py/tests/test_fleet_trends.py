"""Robots that drift or differ are named; those that do neither are not."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
import trackdyn as td
from scipy.stats import linregress
from trackdyn.fleet import _lines, _siblings, _table

#: Days that the logs of a fleet span.
SPAN = 90.0

BEGIN = pd.Timestamp("2026-05-01", tz="UTC")


def fleet(seed, robots=8, logs=10, scatter=0.004, apart=0.008, drift=None, away=None, since=None):
    """A table of robots with chi near 0.5 and logs whose chi has a standard error of 0.0015.

    Parameters
    ----------
    scatter, apart : float
        What chis of a robot scatter beyond their noise, and what robots differ by.
    drift, away : dict
        By robot: change of its chi over the time, and what its chi is away from the others.
    since : dict
        By robot: day from which its logs have a claim. One log in ten has it anyway.
    """
    rng = np.random.default_rng(seed)
    rows = []
    for robot in range(robots):
        level = 0.5 + rng.normal(0.0, apart) + (away or {}).get(robot, 0.0)
        for number, day in enumerate(np.sort(rng.uniform(0.0, SPAN, logs))):
            error = 0.0015 * np.exp(rng.normal(0.0, 0.5))
            change = (drift or {}).get(robot, 0.0) * (day / SPAN - 0.5)
            has = rng.random() < 0.1 or day > (since or {}).get(robot, np.inf)
            rows.append(
                {
                    "log": f"{robot}/{number}",
                    "robot": f"robot{robot}",
                    "time": BEGIN + pd.Timedelta(days=day),
                    "chi": level + change + rng.normal(0.0, np.hypot(error, scatter)),
                    "chi_se": error,
                    "diagnosis": "explained",
                    "claims": [{"one_of": ["slope", "gyro-bias"]}] if has else [],
                }
            )
    return pd.DataFrame(rows)


def named(trends, question):
    return [one.robot for one in trends.robots if getattr(one, question).verdict == "yes"]


@pytest.fixture
def quick(monkeypatch):
    """Fewer simulated siblings."""
    monkeypatch.setattr(_siblings, "_DRAWS", 2000)


@pytest.mark.parametrize("count", [4, 15])
def test_a_line_of_logs_known_alike_is_that_of_least_squares(count):
    rng = np.random.default_rng(count)
    t = np.sort(rng.uniform(0.0, 50.0, count))
    y = 0.5 + 1e-4 * t + rng.normal(0.0, 0.01, count)
    plain = linregress(t, y)
    found = _lines.line(_lines.Series(t, y, np.full(count, 1e-4)), 0.0)
    assert found.slope == pytest.approx(plain.slope, rel=1e-6)
    assert found.p == pytest.approx(plain.pvalue, rel=1e-3)
    # logs that lie better than their noise lie so by chance
    found = _lines.line(_lines.Series(t, y, np.full(count, 0.05)), 0.0)
    assert found.slope == pytest.approx(plain.slope, rel=1e-6)
    assert found.slope_se == pytest.approx(0.05 / np.sqrt(count * np.var(t)), rel=1e-6)
    # τ² = residual variance - s² where all are known alike
    residual = y - plain.intercept - plain.slope * t
    variance = residual @ residual / (count - 2)
    series = _lines.Series(t, y, np.full(count, 0.004))
    expected = np.sqrt(max(variance - 0.004**2, 0.0))
    assert _lines.excess([series]) == pytest.approx(expected, abs=2e-5)
    assert _lines.line(series, 0.0).tau == pytest.approx(expected, abs=2e-5)
    assert _lines.line(series, 0.1).tau == 0.1


@pytest.mark.parametrize(("count", "ratio"), [(4, 1.0), (8, 3.0)])
def test_siblings_alike_are_named_at_most_at_the_rate(quick, count, ratio):
    rng = np.random.default_rng(7)
    fleets, alarms = 100, 0
    for _ in range(fleets):
        errors = np.exp(rng.normal(0.0, 0.5, count))
        values = rng.normal(0.0, np.hypot(errors, ratio))
        # of the smallest p of independent tests: 1 - (1 - p)^n at 5 %
        alarms += _siblings.siblings(values, errors).p.min() < 0.05 / count
    # 5 on average; 13 or more in one of 1500
    assert alarms <= 12


def test_a_fleet_that_does_not_drift_is_named_at_most_at_the_rate(quick):
    questions = ("drift", "drift_beside", "difference")
    found = [td.fleet.trends(fleet(seed, robots=5, logs=5)) for seed in range(30)]
    for question in questions:
        # 1.5 on average; 6 or more in one of 300
        assert sum(bool(named(one, question)) for one in found) <= 5, question
    assert sum(any(c.appeared.verdict == "yes" for c in one.claims) for one in found) <= 5


def test_robots_that_drift_differ_or_show_claims_are_named(quick):
    found = td.fleet.trends(fleet(2, drift={3: -0.05}, away={6: 0.1}, since={5: 45.0}, logs=15))
    assert named(found, "drift") == named(found, "drift_beside") == ["robot3"]
    assert named(found, "difference") == ["robot6"]
    drift = found.robots[3].drift
    assert drift.low < -0.05 * np.ptp(found.robots[3].t) / SPAN < drift.high < 0.0
    (claim,) = [one for one in found.claims if one.appeared.verdict == "yes"]
    # both were claimed together, always
    assert (claim.robot, claim.effect) == ("robot5", "gyro-bias or slope")
    said = str(found)
    assert "robot3 drifts away from its own past: chi changed by -0.0" in said
    assert "robot6 differs from its siblings" in said and "robot5: gyro-bias or slope app" in said
    # those that are named nowhere are steady within 5 %
    assert all(one.drift.verdict == "no" for one in found.robots if one.robot != "robot3")
    frame = found.to_frame().set_index("robot")
    assert frame.loc["robot3", "drift"] == "yes" and frame.loc["robot3", "drift_q"] < 0.05


def test_several_that_differ_do_not_hide_each_other(quick):
    found = td.fleet.trends(fleet(4, robots=10, away={1: 0.1, 2: 0.12}))
    assert named(found, "difference") == ["robot1", "robot2"]


def test_what_all_robots_see_is_no_drift_beside_siblings(quick):
    found = td.fleet.trends(fleet(5, drift={robot: -0.05 for robot in range(8)}))
    assert len(named(found, "drift")) == 8 and not named(found, "drift_beside")


def test_robots_driven_at_other_times_are_compared_at_one(quick):
    table = fleet(8, robots=8, logs=12, apart=0.004)
    # one had its logs in the first month, and all fall by 0.1 in three
    days = (table["time"] - BEGIN) / pd.Timedelta(days=1)
    early = table["robot"] == "robot2"
    days[early] /= 3.0
    table["time"] = BEGIN + pd.to_timedelta(days, unit="D")
    table["chi"] -= 0.1 * days / SPAN
    found = td.fleet.trends(table)
    assert len(named(found, "drift")) == 8 and not named(found, "difference")
    assert abs(found.robots[2].difference.value) < 0.02


def test_few_or_poor_logs_cannot_tell(quick):
    few = td.fleet.trends(fleet(6, robots=3, logs=3))
    for one in few.robots:
        assert one.drift.verdict == "cannot tell" and "logs: 3" in one.drift.reason
        assert one.difference.verdict == "cannot tell" and "compare: 3" in one.difference.reason
    poor = td.fleet.trends(fleet(6, scatter=0.1))
    assert {one.drift.verdict for one in poor.robots} == {"cannot tell"}
    # a change that matters only from half of chi on is excluded
    lenient = td.fleet.trends(fleet(6, scatter=0.02), matters=0.5)
    assert {one.drift.verdict for one in lenient.robots} == {"no"}
    one = td.fleet.trends(fleet(6, robots=8, logs=1))
    assert {of.drift.verdict for of in one.robots} == {"cannot tell"} and str(one)


def test_a_table_on_disk_is_the_frame(quick, tmp_path):
    frame = fleet(2, robots=5, logs=5, since={1: 30.0})
    rows = frame.to_dict("records")
    _table.write(tmp_path / "a.parquet", _table.schema(), rows, None)
    assert str(td.fleet.trends(tmp_path / "a.parquet")) == str(td.fleet.trends(frame))
    assert td.fleet.trends(tmp_path / "a.parquet").claims


def test_logs_that_cannot_count_are_told(quick, tmp_path):
    table = fleet(1)
    table.loc[0, "chi"] = table.loc[0, "chi_se"] = np.nan
    table.loc[1, "time"] = pd.NaT
    found = td.fleet.trends(table)
    assert len(found.notes) == 2 and sum(len(one.t) for one in found.robots) == 78
    with pytest.raises(
        td.InputError, match="no log with ICRs and a time: 80 of 80 logs have stamps"
    ):
        td.fleet.trends(fleet(1).assign(time=pd.NaT))
    with pytest.raises(td.InputError, match="table: no column chi_se"):
        td.fleet.trends(table.drop(columns="chi_se"))
    with pytest.raises(td.InputError, match="no such file"):
        td.fleet.trends(tmp_path / "none.parquet")
    with pytest.raises(td.SettingError, match="rate 5: expected"):
        td.fleet.trends(table, rate=5)


def test_a_picture_names_axes_and_robots(quick):
    figure = td.fleet.trends(fleet(2, drift={3: -0.05}, away={6: 0.1})).plot()
    figure.canvas.draw()
    left, right = figure.axes
    assert "χ (1)" in left.get_ylabel() and "UTC" in left.get_xlabel()
    assert {text.get_text() for text in left.get_legend().get_texts()} == {
        "robot3",
        "robot6",
        "the others",
    }
    labels = [text.get_text() for text in right.get_yticklabels()]
    assert labels[:2] == ["robot3: drifts, beside siblings", "robot6: differs"]
    # nothing is cut
    inside = figure.bbox.padded(1.0)
    for text in [*right.get_yticklabels(), *left.get_xticklabels(), right.xaxis.label]:
        box = text.get_window_extent()
        assert inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0
    plt.close(figure)

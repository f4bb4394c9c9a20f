"""Diagnoses, plans and figures."""

import pickle
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import trackdyn as td


def test_it_names_what_is_missing(diagnosis, told):
    # the poses of a laboratory are 0.03 s late, which 25 s hardly tell from a lag of the belts
    late = [claim for claim in diagnosis.claims if "time-offset" in claim.one_of]
    assert [claim.effect for claim in diagnosis.claims if claim not in late] == ["directional-lugs"]
    assert [size.low < 0.03 < size.high for claim in late for size in claim.sizes] == [True]
    named = {claim.effect: claim for claim in diagnosis.claims}
    size = named["directional-lugs"].sizes[0]
    assert size.name == "excess" and size.low <= size.value <= size.high
    assert size.value == pytest.approx(0.15, abs=0.03)
    assert named["directional-lugs"].p < 0.01
    assert any("directional-lugs" in effect for effect in diagnosis.corrected_vehicle.effects)
    assert told[-1][1] == told[-1][2]
    assert all(refusal.reason for refusal in diagnosis.refusals)


def test_frame_and_page_say_all_claims(diagnosis):
    frame = diagnosis.to_frame()
    rows = sum(max(len(claim.sizes), 1) for claim in diagnosis.claims)
    assert len(frame) == rows and set(frame["effect"]) == {c.effect for c in diagnosis.claims}
    page = diagnosis._repr_html_()
    assert "directional-lugs" in page and diagnosis.status in page
    assert "<html" in diagnosis.report()


def test_a_pickle_holds_what_it_says(diagnosis, tmp_path):
    same = pickle.loads(pickle.dumps(diagnosis))
    assert (same.claims, same.refusals) == (diagnosis.claims, diagnosis.refusals)
    assert same.to_toml() == diagnosis.to_toml()
    assert same.corrected_vehicle == diagnosis.corrected_vehicle
    assert same._repr_html_() == diagnosis._repr_html_()
    for ask in (lambda: same.figures, same.report, lambda: same.write(tmp_path)):
        with pytest.raises(td.ResultError, match="unpickled holds what it says"):
            ask()


def test_it_writes_what_the_program_reads(diagnosis, program, tmp_path):
    files = {Path(file).name for file in diagnosis.write(tmp_path)}
    assert {"diagnosis.toml", "vehicle.corrected.toml", "report.html", "plane.png"} <= files
    assert td.Vehicle(tmp_path / "vehicle.corrected.toml") == diagnosis.corrected_vehicle
    done = program("plan", "--diagnosis", tmp_path / "diagnosis.toml", "--out", tmp_path / "plan")
    assert done.returncode == 0, done.stderr
    by_file, by_value = td.plan(tmp_path / "diagnosis.toml"), td.plan(diagnosis)
    assert repr(by_file) == repr(by_value)


def test_it_says_what_dead_reckoning_loses(recording, robot):
    """A drive that is long enough; the short one says nothing of it."""
    turned = robot.with_effect("encoder-scale", left=0.9)
    driven = td.diagnose(recording, turned, draws=1000)
    assert set(driven.drift) == {"place_m_per_100_m", "yaw_deg_per_turn"}
    for of in driven.drift.values():
        assert of["after95"][0] <= of["after"] <= of["after95"][1]
        assert of["pose_noise"] < of["before"] and of["pieces"] >= 10
        assert of["after"] < 0.5 * of["before"]
    assert "dead reckoning" in driven._repr_html_()


def test_settings_count(diagnosis, recording, model):
    assert diagnosis.to_dict()["settings"] == {"verdict": {"max_p": 0.008}}
    with pytest.raises(td.DocumentError, match="min_ln_bayes_factor"):
        td.diagnose(recording, model, settings={"verdict": {"min_ln_bayes_factor": -1.0}})


def drawn(figure):
    """Draws every panel; the number of things that its axes show."""
    shown = 0
    for place, panel in enumerate(figure.data["panels"]):
        fig, ax = plt.subplots()
        assert figure.plot(place, ax) is ax
        assert ax.get_xlim() == pytest.approx(panel["x"]["range"])
        shown += len(ax.get_children())
        fig.canvas.draw()
        plt.close(fig)
    return shown


def test_figures_are_data_pictures_and_axes(diagnosis, robot, tmp_path):
    solved = td.icr_map(robot.with_effect("load-transfer", cog_height_m=0.3), points=7)
    for figure in [*diagnosis.figures, solved.figure]:
        assert figure.to_png().startswith(b"\x89PNG") and "<svg" in figure.to_svg()
        assert drawn(figure) > 10, figure
    solved.figure.save(tmp_path / "map.svg")
    solved.figure.save(tmp_path / "map.png")
    assert (tmp_path / "map.png").read_bytes() == solved.figure.to_png()


def test_a_heat_map_shows_its_numbers(robot):
    solved = td.icr_map(robot.with_effect("load-transfer", cog_height_m=0.3), points=7)
    panels = solved.figure.data["panels"]
    heat = next(k for k, of in enumerate(panels) if of["series"][0]["sign"]["kind"] == "cells")
    fig, ax = plt.subplots()
    solved.figure.plot(heat, ax)
    mesh = np.ma.filled(ax.collections[0].get_array(), np.nan)
    shown = np.sort(mesh[np.isfinite(mesh)])
    quantities = [solved.x_l, solved.x_r, solved.y]
    finite = [np.sort(of[np.isfinite(of)]) for of in quantities]
    assert any(len(of) == len(shown) and np.allclose(of, shown) for of in finite)
    plt.close(fig)


def test_axes_say_which_line_is_which(robot, recording):
    fitted = td.IcrKinematics(robot).fit(recording)
    replay = td.odometry(recording, robot, [fitted.parameters_])
    fig, ax = plt.subplots()
    replay.figure.plot(0, ax)
    said = [text.get_text() for text in ax.get_legend().get_texts()]
    assert said[:2] == ["recorded", "ideal"] and len(said) == len(set(said))
    plt.close(fig)

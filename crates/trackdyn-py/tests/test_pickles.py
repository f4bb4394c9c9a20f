"""Everything that a user holds can be sent to another process."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import trackdyn as td


def copied(thing):
    return pickle.loads(pickle.dumps(thing))


def assert_same(one, other):
    for series in ("tracks", "poses", "imu", "points"):
        first, second = getattr(one, series), getattr(other, series)
        assert list(first) == list(second)
        assert all(np.array_equal(first[k], second[k], equal_nan=True) for k in first), series
    assert one.info == other.info and one.fingerprint == other.fingerprint


def test_vehicles_and_parameters(robot, recording):
    tall = robot.with_effect("load-transfer")
    assert copied(tall) == tall == copy.deepcopy(tall)
    parameters = td.IcrKinematics(robot).fit(recording).parameters_
    same = copied(parameters)
    assert same == parameters and same.name == parameters.name


def test_recordings(recording, robot):
    for of in (recording, recording.part(runs="1-2"), recording.part(time=(2.0, 20.0))):
        same = copied(of)
        assert_same(of, same)
        # it is still known where it comes from: parameters that were fitted to it are not advised
        fitted = td.IcrKinematics(robot).fit(of)
        again = td.IcrKinematics(robot).fit(same)
        assert again.parameters_ == fitted.parameters_
        assert td.odometry(same, robot, fitted.parameters_).advice is None


def test_recordings_of_files(drive, tmp_path):
    drive.write(tmp_path / "drive")
    read = td.read_recording(tmp_path / "drive")
    assert_same(read, copied(read))
    assert copied(read).info["place"] == str(tmp_path / "drive")
    table = tmp_path / "points.csv"
    table.write_text("v_left,v_right,v_forward,v_lateral,yaw_rate\n0.1,0.4,0.2,,0.3\n")
    points = td.read_recording(table)
    assert_same(points, copied(points))


def test_warnings_are_kept(recording):
    tracks = recording.part(runs=0).tracks.to_array("t", "v_left", "v_right")
    tracks[5, 1] = np.nan
    poses = recording.part(runs=0).poses.to_array("t", "x", "y", "yaw")
    with pytest.warns(td.Warning):
        of = td.Recording.from_arrays(tracks, poses)
    assert copied(of).warnings == of.warnings != []


def test_a_pickle_that_was_tampered_with_is_refused(recording):
    state = recording.__getstate__()
    state["kept"]["motion"]["runs"][0][1][7, 0] = np.nan
    with pytest.raises(td.RecordingError, match="expected it unchanged"):
        object.__new__(td.Recording).__setstate__(state)


def test_estimators(robot, recording):
    fitted = td.IcrKinematics(robot, alphas=True).fit(recording)
    same = copied(fitted)
    assert same.x_l_ == fitted.x_l_ and np.array_equal(same.covariance_, fitted.covariance_)
    assert np.array_equal(same.predict(0.1, 0.4), fitted.predict(0.1, 0.4))
    assert same.get_params() == fitted.get_params()
    with pytest.raises(td.ResultError, match="unpickled"):
        same.write("nowhere")


def _fit(of):
    return td.IcrKinematics("auriga-alpha").fit(of).x_r_


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes_work(recording, method):
    expected = _fit(recording)
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map_async(_fit, [recording] * 3).get(timeout=120) == [expected] * 3


def shown(result):
    """What a result shows: properties, what it is as a dict, and how it is printed."""
    names = [name for name in dir(result) if not name.startswith("_")]
    values = {name: getattr(result, name) for name in names if not hasattr(type(result), name)}
    for name in names:
        of = getattr(type(result), name, None)
        if isinstance(of, property) or hasattr(of, "__set__"):
            values[name] = getattr(result, name)
    if hasattr(result, "to_dict"):
        values["to_dict"] = result.to_dict()
    return {**values, "repr": repr(result), "html": getattr(result, "_repr_html_", str)()}


def assert_alike(one, other, place=""):
    assert type(one) is type(other), place
    if isinstance(one, td.Recording):
        assert_same(one, other)
    elif isinstance(one, td.Figure):
        assert one.to_svg() == other.to_svg() and one.to_png() == other.to_png(), place
        assert_alike(one.data, other.data, f"{place}.data")
    elif isinstance(one, np.ndarray):
        assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f"), place
    elif isinstance(one, dict):
        assert list(one) == list(other), place
        for key in one:
            assert_alike(one[key], other[key], f"{place}.{key}")
    elif isinstance(one, (list, tuple)):
        assert len(one) == len(other), place
        for number, pair in enumerate(zip(one, other)):
            assert_alike(*pair, f"{place}[{number}]")
    else:
        assert one == other or one != one, place


@pytest.fixture(scope="module")
def results(robot, drive, recording, diagnosis, tmp_path_factory):
    """A result of each kind, with how it writes its files where it does."""
    parameters = td.IcrKinematics(robot).fit(recording).parameters_
    folder = tmp_path_factory.mktemp("inspected")
    drive.write(folder / "drive")
    icr_map = td.icr_map(robot, points=7, max_speed=0.8)
    open_questions = diagnosis.to_toml()
    (folder / "diagnosis.toml").write_text(open_questions)
    return {
        "Simulation": drive,
        "IcrMap": icr_map,
        "Odometry": td.odometry(recording, robot, [parameters], time=(0.0, 20.0)),
        "Odometry of a gauge": td.odometry(recording, 0.42),
        "MotionTable": td.motion_table(robot, fastest=0.8),
        "Plan": td.plan(diagnosis, duration=20.0),
        "Inspection": td.inspect(folder / "drive", vehicle=robot),
        "Figure": icr_map.figure,
    }


KINDS = ["Simulation", "IcrMap", "Odometry", "Odometry of a gauge", "MotionTable", "Plan"]


@pytest.mark.parametrize("kind", [*KINDS, "Inspection", "Figure"])
@pytest.mark.parametrize("copy_of", [copied, copy.deepcopy, copy.copy])
def test_results_show_the_same_in_another_process(results, kind, copy_of):
    result = results[kind]
    same = copy_of(result)
    assert_alike(shown(result), shown(same), kind)
    # a copy of a copy is one, too
    assert_alike(shown(result), shown(copy_of(same)), kind)


@pytest.mark.parametrize("kind", KINDS)
def test_results_write_the_same_files_in_another_process(results, kind, tmp_path):
    both = results[kind], copied(results[kind])
    files = [one.write(tmp_path / str(k)) for k, one in enumerate(both)]
    assert [path.name for path in files[0]] == [path.name for path in files[1]]
    for one, other in zip(*files):
        assert one.read_bytes() == other.read_bytes(), one


def test_what_is_in_a_pickle_can_be_read_without_computing(results, monkeypatch):
    from trackdyn import _result

    same = {kind: pickle.dumps(results[kind]) for kind in KINDS}
    monkeypatch.setattr(_result.Result, "_inner", property(lambda self: pytest.fail("computed")))
    simulation, icr_map, odometry, _, table, plan = (pickle.loads(same[kind]) for kind in KINDS)
    assert simulation.truth.rows and simulation.recording.runs and simulation.to_dict()
    assert icr_map.statistics and icr_map.parameters and icr_map.x_l.shape == (7, 7)
    assert odometry.to_dict() and odometry.paths and odometry.errors_at_end.any()
    assert table.files and table.error < 1.0
    assert plan.to_dict() and repr(plan)
    assert not simulation.truth["x"].flags.writeable


def test_a_copy_of_a_diagnosis_still_has_its_figures(diagnosis):
    assert copy.deepcopy(diagnosis).report() == diagnosis.report()

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

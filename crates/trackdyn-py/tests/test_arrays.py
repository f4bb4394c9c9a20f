"""Recordings as arrays, and arrays as recordings."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

import trackdyn as td


def test_a_column_is_the_memory_of_all_its_views(recording):
    for series in ("tracks", "poses", "imu"):
        first, again = getattr(recording, series), getattr(recording, series)
        for name, column in first.items():
            assert np.shares_memory(column, again[name]), name
            assert np.shares_memory(column, np.asarray(first[name])), name
            assert column.flags.c_contiguous and not column.flags.writeable, name
            assert column.dtype == (np.int64 if name == "run" else np.float64)
            assert len(column) == first.rows > 0


def test_an_array_owns_what_it_shows(robot):
    column = td.simulate(robot, runs=1, duration=5.0).recording.tracks["v_left"]
    before = column.copy()
    # the recording is gone; others take memory
    others = [td.simulate(robot, runs=1, duration=5.0, seed=k).recording.tracks for k in range(5)]
    assert len(others) == 5 and np.array_equal(column, before)


def test_runs_stand_one_after_the_other(recording):
    run, t = recording.tracks["run"], recording.tracks["t"]
    assert recording.runs == [0, 1, 2] == sorted(set(run.tolist()))
    for number in recording.runs:
        assert np.all(np.diff(t[run == number]) > 0)
    part = recording.part(runs=1)
    assert np.array_equal(part.tracks["t"], t[run == 1])
    assert part.fingerprint == recording.fingerprint
    within = recording.part(time=(0.0, 5.0))
    assert all(np.ptp(within.tracks["t"][within.tracks["run"] == k]) <= 5.0 for k in within.runs)


def test_arrow_takes_a_table(recording):
    table = pa.table(recording.poses)
    assert table.schema.names == ["run", "t", "x", "y", "yaw"]
    assert table.schema.types == [pa.int64()] + 4 * [pa.float64()]
    for name in table.schema.names:
        assert np.array_equal(table[name].to_numpy(), recording.poses[name])
    # a stream that nobody takes is released with its capsule
    for _ in range(100):
        assert "arrow_array_stream" in repr(recording.poses.__arrow_c_stream__())


def test_pandas_takes_a_table(recording):
    frame = pd.DataFrame(recording.tracks)
    assert list(frame) == ["run", "t", "v_left", "v_right"]
    assert frame.equals(recording.tracks.to_frame())
    assert np.array_equal(recording.tracks.to_structured()["v_left"], frame["v_left"])
    assert recording.tracks.to_array("t", "v_left").shape == (len(frame), 2)


@pytest.mark.parametrize("kind", ["dict", "frame", "arrow", "batch", "structured", "array"])
def test_a_recording_of_arrays_is_the_recording(recording, kind):
    one = recording.part(runs=1)
    convert = {
        "dict": dict,
        "frame": pd.DataFrame,
        "arrow": pa.table,
        "batch": lambda table: pa.RecordBatch.from_pydict(dict(table)),
        "structured": lambda table: table.to_structured(),
        "array": lambda table: table.to_array(*[name for name in table if name != "run"]),
    }[kind]
    of = td.Recording.from_arrays(convert(one.tracks), convert(one.poses), convert(one.imu))
    for series in ("tracks", "poses", "imu"):
        expected, found = getattr(one, series), getattr(of, series)
        for name in [name for name in expected if name != "run"]:
            assert np.array_equal(expected[name], found[name]), (series, name)
    assert of.runs == ([0] if kind == "array" else [1])
    assert not np.shares_memory(of.tracks["t"], one.tracks["t"])


def test_arrays_are_cleaned_and_told_of(recording):
    one = recording.part(runs=1)
    tracks = one.tracks.to_array("t", "v_left", "v_right")
    tracks[10, 1] = np.nan
    poses = one.poses.to_array("t", "x", "y", "yaw")
    with pytest.warns(td.Warning, match="arrays: tracks: 1 rows with an empty cell, NaN"):
        cleaned = td.Recording.from_arrays(tracks, poses)
    assert cleaned.tracks.rows == len(tracks) - 1
    assert cleaned.warnings


def test_arrays_of_another_unit_are_refused_unless_accepted(recording):
    one = recording.part(runs=1)
    tracks = one.tracks.to_array("t", "v_left", "v_right")
    tracks[:, 1:] *= 3.6
    poses = one.poses.to_array("t", "x", "y", "yaw")
    with pytest.raises(td.RecordingError, match="the tracks travel .* times as far as the poses"):
        td.Recording.from_arrays(tracks, poses)
    with pytest.warns(td.Warning, match="the tracks travel"):
        td.Recording.from_arrays(tracks, poses, accept="travel")


def test_tables_that_do_not_go_together_are_refused(recording):
    one = recording.part(runs=1)
    bare = one.tracks.to_array("t", "v_left", "v_right")
    for tracks, poses, words in [
        (bare, one.poses, "tracks: no column run"),
        (one.tracks, bare, r"poses: an array of shape \(\d+, 3\): expected \(n, 4\)"),
        ({"t": [0.0], "v_left": [0.0]}, one.poses, "tracks: columns t, v_left: expected t, v_left"),
        ({**one.tracks, "t": [0.0]}, one.poses, "expected one length"),
    ]:
        with pytest.raises(td.RecordingError, match=words):
            td.Recording.from_arrays(tracks, poses)


def test_info_says_what_it_is(recording):
    info = recording.info
    assert info["kind"] == "motion" and info["runs"] == [0, 1, 2] and info["has_positions"]
    assert info["tracks"] == recording.tracks.rows
    durations = sum(
        np.ptp(recording.tracks["t"][recording.tracks["run"] == k]) for k in recording.runs
    )
    assert info["duration"] == pytest.approx(durations)
    assert "Recording" in recording._repr_html_()

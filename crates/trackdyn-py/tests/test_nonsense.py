"""What is of another kind than a keyword takes is refused in words, as a kind of td.Error."""

from pathlib import Path

import numpy as np
import pytest

import trackdyn as td

#: Of no use to any keyword: neither number, text, path, flag nor rows of numbers.
NONSENSE = {
    "object": object(),
    "bytes": b"x",
    "complex": 1j,
    "set": {"a"},
    "words": np.array([["a", "b"]]),
    "ragged": [[1.0], [2.0, 3.0]],
    "not a number": float("nan"),
}


@pytest.fixture(scope="module")
def of(robot, recording):
    """What calls are made of."""
    fitted = td.IcrKinematics(robot, generations=2).fit(recording)
    replay = td.odometry(recording, robot, fitted.parameters_)
    return {
        "robot": robot,
        "log": recording,
        "fitted": fitted,
        "parameters": fitted.parameters_,
        "replay": replay,
        "table": td.motion_table(robot),
        "tracks": recording.tracks.to_array("t", "v_left", "v_right"),
        "poses": recording.poses.to_array("t", "x", "y", "yaw"),
    }


def _keywords(call, *names):
    return {name: lambda of, value, name=name: call(of, {name: value}) for name in names}


NUMBERS = {"gauge": 0.4, "mass": 200.0, "contact_length": 0.7, "width": 0.15}
NONE = "none.mcap"

CALLS = {
    "vehicle": lambda of, value: td.Vehicle(value),
    **_keywords(
        lambda of, given: td.Vehicle(**{**NUMBERS, **given}),
        *("gauge", "mass", "contact_length", "width", "axles", "cog", "friction", "effects"),
    ),
    "with_effect": lambda of, value: of["robot"].with_effect("load-transfer", cog_height_m=value),
    "with_cog": lambda of, value: of["robot"].with_cog(value, 0.0),
    "with_inertia": lambda of, value: of["robot"].with_inertia(value),
    "with_values": lambda of, value: of["robot"].with_values(value),
    "with_values, a value": lambda of, value: of["robot"].with_values({"mass_kg": value}),
    "with_values, a place": lambda of, value: of["robot"].with_values({"mass_kg.x": value}),
    "Vehicle.from_toml": lambda of, value: td.Vehicle.from_toml(value),
    "Vehicle.write": lambda of, value: of["robot"].write(value),
    "read_recording": lambda of, value: td.read_recording(value),
    **_keywords(
        lambda of, given: td.read_recording(NONE, **given),
        *("tracks", "columns", "pose_topic", "left_joints", "joint_signal", "wheel_radius"),
        *("pose_index", "speed_unit", "msg_dir", "dated_by", "pose_axes", "mount_yaw", "gyro_unit"),
        "accept",
    ),
    "tracks of arrays": lambda of, value: td.Recording.from_arrays(value, of["poses"]),
    "poses of arrays": lambda of, value: td.Recording.from_arrays(of["tracks"], value),
    "imu of arrays": lambda of, value: td.Recording.from_arrays(of["tracks"], of["poses"], value),
    "a column of arrays": lambda of, value: td.Recording.from_arrays(
        {"t": value, "v_left": value, "v_right": value}, of["poses"]
    ),
    "part, runs": lambda of, value: of["log"].part(runs=value),
    "part, time": lambda of, value: of["log"].part(time=value),
    **_keywords(
        lambda of, given: td.IcrKinematics(**{"vehicle": 0.42, **given}).fit(of["log"]),
        *("vehicle", "alphas", "tau", "settle", "nuisances", "gyroscope", "force", "seed"),
        *("population", "generations", "progress"),
    ),
    "fit": lambda of, value: td.IcrKinematics(0.42).fit(value),
    "score": lambda of, value: of["fitted"].score(value),
    "predict": lambda of, value: of["fitted"].predict(value),
    "odometry, recording": lambda of, value: td.odometry(value, 0.42),
    "odometry, vehicle": lambda of, value: td.odometry(of["log"], value),
    "odometry, parameters": lambda of, value: td.odometry(of["log"], 0.42, value),
    **_keywords(lambda of, given: td.odometry(of["log"], 0.42, **given), "runs", "gyroscope"),
    "diagnose, recordings": lambda of, value: td.diagnose(value, "maxxii"),
    **_keywords(
        lambda of, given: td.diagnose(of["log"], "maxxii", **given),
        *("settings", "held_out", "draws", "seed"),
    ),
    **_keywords(
        lambda of, given: td.simulate("maxxii", **given),
        *("schedule", "seed", "runs", "duration", "fastest", "sensors", "start", "inertia"),
        *("longest_step", "progress"),
    ),
    "vehicles": lambda of, value: td.simulate_batch(value),
    **_keywords(
        lambda of, given: td.simulate_batch(["maxxii"], runs=1, duration=1.0, **given),
        *("parameters", "seed", "errors"),
    ),
    **_keywords(
        lambda of, given: td.icr_map("maxxii", **given),
        *("points", "max_speed", "position", "heading", "time"),
    ),
    "inspect": lambda of, value: td.inspect(value),
    **_keywords(lambda of, given: td.inspect(NONE, **given), "vehicle", "parameters", "tau"),
    "plan": lambda of, value: td.plan(value),
    "Parameters": lambda of, value: td.Parameters(value),
    "motion_table": lambda of, value: td.motion_table("maxxii", fastest=value),
    **_keywords(
        lambda of, given: of["parameters"].write_ros2("ros2", **{"wheel_radius": 0.1, **given}),
        *("wheel_radius", "left_joints", "base_frame", "contact_centre", "controller", "residuals"),
        "publish_rate",
    ),
    "write": lambda of, value: of["replay"].write(value),
    "write_layers": lambda of, value: of["replay"].write_layers(value),
    "save": lambda of, value: of["replay"].figure.save(value),
    "plot, panel": lambda of, value: of["replay"].figure.plot(value),
    "plot, ax": lambda of, value: of["replay"].figure.plot(0, value),
    "fleet, logs": lambda of, value: td.fleet.run(value, "maxxii", "out.parquet"),
    **_keywords(
        lambda of, given: td.fleet.run(__file__, "maxxii", "out.parquet", **given),
        *("robot", "time", "diagnose", "identify", "workers", "timeout", "memory"),
    ),
    "fleet, out": lambda of, value: td.fleet.run(__file__, "maxxii", value),
    "fleet, vehicle": lambda of, value: td.fleet.run(__file__, value, "out.parquet"),
    "trends": lambda of, value: td.fleet.trends(value),
    "trends, rate": lambda of, value: td.fleet.trends("out.parquet", rate=value),
}


@pytest.mark.parametrize("call", CALLS)
def test_nonsense_is_refused_in_words(of, call, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, value in NONSENSE.items():
        with pytest.raises(td.Error) as raised:
            print(CALLS[call](of, value), "of", name)
        assert "expected" in str(raised.value), (name, raised.value)
    assert list(tmp_path.iterdir()) == []


def test_what_is_close_is_taken(of, tmp_path):
    """Types of NumPy, floats that are whole, lists in place of tuples, numbers without a dimension."""
    assert of["log"].part(runs=np.int64(1)).runs == of["log"].part(runs=1.0).runs == [1]
    assert of["log"].part(runs=np.array([0, 2])).runs == of["log"].part(runs=(0, 2)).runs == [0, 2]
    assert of["log"].part(time=[np.float32(1), 5]).info["duration"] < 13.0
    robot = td.Vehicle(**{key: np.float64(value) for key, value in NUMBERS.items()}, effects="slope")
    assert len(robot.effects) == 1
    one = td.simulate("maxxii", runs=np.int32(1), duration=np.array(2.0), seed=3.0, inertia=np.True_)
    assert one.recording.runs == [0]
    assert of["parameters"].predict(np.float32(0.5), [0.2, 0.3]).shape == (2, 3)
    assert of["table"].predict([], []).shape == (0, 3)
    of["parameters"].write(Path(tmp_path) / "kinematics.toml")


def test_shapes_that_do_not_go_together():
    with pytest.raises(td.SettingError, match=r"v_l of shape \(3,\) and v_r of shape \(2,\)"):
        td.motion_table("maxxii").predict([1.0, 2.0, 3.0], [1.0, 2.0])


def test_files_that_are_not_there(of, tmp_path):
    for call in (
        lambda path: td.diagnose(of["log"], "maxxii", settings=path),
        lambda path: td.plan(path),
        lambda path: of["parameters"].write_ros2(tmp_path, wheel_radius=0.1, residuals=path),
    ):
        with pytest.raises(td.DocumentError, match="none.toml: cannot be read: No such file"):
            call(tmp_path / "none.toml")
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(td.DocumentError, match="no text in UTF-8"):
        td.plan(tmp_path / "bytes.toml")
    with pytest.raises(td.OutputError, match="cannot be written"):
        of["replay"].figure.save(tmp_path / "none" / "x.png")
    with (tmp_path / "open.csv").open("w") as file, pytest.raises(td.SettingError, match="a path"):
        td.read_recording(file)

"""Errors by kind, and warnings."""

import pickle

import pytest

import trackdyn as td


def test_every_kind_is_an_error_and_a_usual_one():
    kinds = [of for of in vars(td).values() if isinstance(of, type) and issubclass(of, td.Error)]
    assert len(kinds) > 15
    for kind in kinds:
        if kind is not td.Error:
            assert issubclass(kind, (ValueError, RuntimeError)), kind
        error = pickle.loads(pickle.dumps(kind("time 3: expected 2", "time")))
        assert type(error) is kind and str(error) == "time 3: expected 2" and error.setting == "time"
        assert kind.__module__ == "trackdyn"


@pytest.mark.parametrize(
    ("kind", "setting", "words", "call"),
    [
        (td.RecordingError, "runs", "run 77 is not in", lambda of: of.part(runs=77)),
        (td.RecordingError, "time", "time: no run has", lambda of: of.part(time=(900, 901))),
        (td.SettingError, "time", "expected the beginning", lambda of: of.part(time=(2, 1))),
        (td.SettingError, "runs", "such as 7,8,20-29", lambda of: of.part(runs="a")),
        (td.VehicleError, "gauge", "gauge -1: expected", lambda of: td.odometry(of, -1.0)),
        (td.RecordingError, None, "no recording: expected", lambda of: td.diagnose([], "maxxii")),
        (
            td.RecordingError,
            None,
            "expected each recording once",
            lambda of: td.diagnose([of, of], "maxxii"),
        ),
        (td.HeldOutError, "held_out", "run 9", lambda of: td.diagnose(of, "maxxii", held_out=9)),
        (td.HeldOutError, "held_out", "at least", lambda of: td.diagnose(of, "maxxii", held_out="0-2")),
        (td.SettingError, "draws", "expected 1000", lambda of: td.diagnose(of, "maxxii", draws=3)),
        (td.SettingError, "seed", "seed -1: expected 0", lambda of: td.diagnose(of, "maxxii", seed=-1)),
        (td.SettingError, "seed", "seed -1: expected 0", lambda of: td.simulate("maxxii", seed=-1)),
        (
            td.DocumentError,
            None,
            "settings:1",
            lambda of: td.diagnose(of, "maxxii", settings={"verdikt": {"max_p": 0.1}}),
        ),
        (
            td.SettingError,
            "nuisances",
            "nuisances lever",
            lambda of: td.IcrKinematics(0.42, nuisances="lever").fit(of),
        ),
        (td.SettingError, "points", "points 1: expected 2", lambda of: td.icr_map("maxxii", points=1)),
        (
            td.SettingError,
            "gyro_unit",
            "gyro_unit rpm: expected one of rad/s, deg/s",
            lambda of: td.read_recording("x", gyro_unit="rpm"),
        ),
        (td.SettingError, "schedule", "schedule: a schedule", lambda of: td.simulate("maxxii", [[0.0, 0.0, 0.0]])),
        (td.DrivingError, None, "expected (n, 3)", lambda of: td.simulate("maxxii", [0.0, 1.0])),
    ],
)
def test_kinds_settings_and_words(recording, kind, setting, words, call):
    with pytest.raises(td.Error) as raised:
        call(recording)
    assert words in str(raised.value)
    assert (type(raised.value), raised.value.setting) == (kind, setting)


def test_what_is_not_determined_is_told(robot):
    straight = [[0.0, 0.0, 0.0], [2.0, 0.5, 0.5], [30.0, 0.0, 0.0], [32.0, 0.0, 0.0]]
    log = td.simulate(robot, straight).recording
    with pytest.raises(td.IdentifyError) as raised:
        td.IcrKinematics(robot).fit(log)
    assert str(raised.value).startswith(f"{log.name}: ")


def test_what_callers_raise_comes_through(robot):
    def progress(stage, done, total):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        td.icr_map(robot, progress=progress)

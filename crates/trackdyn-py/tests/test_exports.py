"""Files for other programs: those of the program, to the byte but for the command that they name."""

import numpy as np
import pytest

import trackdyn as td


@pytest.fixture(scope="module")
def parameters(robot, drive):
    return td.IcrKinematics(robot).fit(drive.recording.part(runs=[0, 1])).parameters_


@pytest.fixture(scope="module")
def replay(robot, drive, parameters):
    return td.odometry(drive.recording, robot, parameters, runs=2)


def _said(path):
    """What a file says, without the command that made it."""
    lines = path.read_text().splitlines()
    return [line for line in lines if "command" not in line and "trackdyn export" not in line]


def _names(paths):
    return sorted(path.name for path in paths)


def test_layers_of_a_replay(program, drive, robot, parameters, tmp_path):
    drive.write(tmp_path / "drive")
    parameters.write(tmp_path / "kinematics.toml")
    log = td.read_recording(tmp_path / "drive")
    chosen = td.Parameters(tmp_path / "kinematics.toml")
    ours = td.odometry(log, robot, chosen).write_layers(tmp_path / "ours")
    words = ["--kinematics", tmp_path / "kinematics.toml", "--vehicle", "auriga-alpha"]
    done = program("export", "mcap", tmp_path / "drive", *words, "--out", tmp_path / "theirs")
    assert done.returncode == 0, done.stderr
    names = ["odometry.foxglove.json", "odometry.mcap", "odometry.plotjuggler.xml"]
    assert _names(ours) == _names((tmp_path / "theirs").iterdir()) == names
    for name in (names[0], names[2]):
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    assert _messages(tmp_path / "ours" / names[1]) == _messages(tmp_path / "theirs" / names[1])


def _messages(path):
    reader = pytest.importorskip("mcap.reader")
    with path.open("rb") as file:
        messages = reader.make_reader(file).iter_messages()
        found = [(channel.topic, of.log_time, of.data) for _, channel, of in messages]
    assert len(found) > 1000
    return found


def test_layers_of_a_diagnosis(diagnosis, tmp_path):
    diagnosis.write(tmp_path)
    files = diagnosis.write_layers(tmp_path)
    assert _names(files) == [
        f"diagnosis.{of}" for of in ("foxglove.json", "mcap", "plotjuggler.xml")
    ]
    topics = {topic for topic, _, _ in _messages(tmp_path / "diagnosis.mcap")}
    assert "/tf" in topics and any("corrected" in topic for topic in topics), topics
    # those of an earlier diagnosis go
    diagnosis.write(tmp_path)
    assert not any(file.exists() for file in files)


def test_the_table_is_that_of_the_program(program, tmp_path):
    robot = td.Vehicle("auriga-alpha", effects=["load-transfer:cog_height_m=0.3", "centripetal"])
    table = td.motion_table(robot, fastest=0.8)
    files = table.write(tmp_path / "ours")
    effects = ["--effect", "load-transfer:cog_height_m=0.3", "--effect", "centripetal"]
    done = program("export", "table", *effects, "--fastest", 0.8, "--out", tmp_path / "theirs")
    assert done.returncode == 0, done.stderr
    assert _names(files) == ["motion_table.toml", "trackdyn_motion.h"] == sorted(table.files)
    for file in files:
        assert file.read_text() == table.files[file.name]
        assert _said(file) == _said(tmp_path / "theirs" / file.name)


def test_the_table_says_what_the_model_does():
    robot = td.Vehicle("auriga-alpha", effects=["load-transfer:cog_height_m=0.3", "centripetal"])
    table, solved = td.motion_table(robot), td.icr_map(robot, points=7)
    turns = solved.status == solved.status_names.index("turning")
    found = table.predict(solved.speeds[:, None], solved.speeds[None, :])
    expected = np.stack([solved.v_forward, solved.v_lateral, solved.yaw_rate], axis=-1)
    assert found.shape == (7, 7, 3) and turns.sum() > 30
    # a yaw rate counts as the track speed that it is at half the gauge
    assert np.abs(found - expected)[turns].max() < 5.0 * table.error
    # derivatives are those of the motion
    by, step = table.derivatives(0.3, 0.7), 1e-6
    assert by.shape == (3, 2)
    ahead = np.array([table.predict(0.3 + step, 0.7), table.predict(0.3, 0.7 + step)])
    behind = np.array([table.predict(0.3 - step, 0.7), table.predict(0.3, 0.7 - step)])
    assert np.allclose((ahead - behind).T / (2.0 * step), by, atol=1e-6)
    assert table.unsolved == 0.0 and "polynomials" in repr(table)


def test_ros2_is_that_of_the_program(program, parameters, replay, tmp_path):
    parameters.write(tmp_path / "kinematics.toml")
    replay.write(tmp_path)
    chosen = td.Parameters(tmp_path / "kinematics.toml")
    files = chosen.write_ros2(tmp_path / "ours", wheel_radius=0.1, residuals=replay)
    words = ["--wheel-radius", 0.1, "--residuals", tmp_path / "odometry.toml"]
    out = ["--out", tmp_path / "theirs"]
    done = program("export", "ros2", tmp_path / "kinematics.toml", *words, *out)
    assert done.returncode == 0, done.stderr
    assert _names(files) == ["diff_drive_controller.yaml", "icr_frame.launch.py"]
    for file in files:
        ours, theirs = (_said(of) for of in (file, tmp_path / "theirs" / file.name))
        ours = [line.replace(" odometry.toml", f" {tmp_path}/odometry.toml") for line in ours]
        assert ours == theirs
    assert "pose_covariance_diagonal" in files[0].read_text()


def test_residuals_of_a_fit_are_warned_of(robot, drive, parameters, tmp_path):
    replay = td.odometry(drive.recording, robot, parameters, runs=0)
    with pytest.warns(td.Warning, match="come out too small"):
        parameters.write_ros2(tmp_path, wheel_radius=0.1, residuals=replay)


@pytest.mark.parametrize(
    ("setting", "words", "keywords"),
    [
        ("wheel_radius", "does not tell it", {}),
        ("left_joints", "left_joints a b: ", {"wheel_radius": 0.1, "left_joints": "a b"}),
        ("controller", "controller x-y: ", {"wheel_radius": 0.1, "controller": "x-y"}),
    ],
)
def test_exports_say_what_they_need(parameters, tmp_path, setting, words, keywords):
    with pytest.raises(td.SettingError) as raised:
        parameters.write_ros2(tmp_path, **keywords)
    assert raised.value.setting == setting and words in str(raised.value)


def test_a_table_needs_a_speed(robot):
    with pytest.raises(td.SettingError, match="fastest 0: expected a track speed"):
        td.motion_table(robot, fastest=0.0)


def test_layers_of_a_diagnosis_have_claims_and_the_ideal_drive(diagnosis, tmp_path):
    reader = pytest.importorskip("mcap.reader")
    decoder = pytest.importorskip("mcap_ros2.decoder")
    (path,) = [one for one in diagnosis.write_layers(tmp_path) if one.suffix == ".mcap"]

    def messages(topic):
        with path.open("rb") as file:
            bag = reader.make_reader(file, True, [decoder.DecoderFactory()])
            return [of.decoded_message for of in bag.iter_decoded_messages(topic)]

    (said,) = {of.data for of in messages("/trackdyn/claims")}
    lines = said.split("\n")
    assert lines[0] == diagnosis.status
    for claim in diagnosis.claims:
        assert any(" or ".join(claim.one_of) in line for line in lines), said
    # tracks that do not slip turn the robot further than it turned
    turned = {}
    for name in ("observed", "ideal"):
        poses = [of.pose.orientation for of in messages(f"/trackdyn/{name}/pose")]
        yaw = np.unwrap([2.0 * np.arctan2(of.z, of.w) for of in poses])
        turned[name] = np.sum(np.abs(np.diff(yaw)))
    assert turned["ideal"] > 1.2 * turned["observed"] > 0.0, turned

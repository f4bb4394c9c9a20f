"""The package says what the program of the wheel says, to the last digit and in its words."""

import numpy as np
import pytest

import trackdyn as td


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    """A drive that the program simulated."""
    folder = tmp_path_factory.mktemp("drive")
    done = program("simulate", "--run-count", 3, "--seed", 4, "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder


def test_version(program):
    assert program("--version").stdout.split() == ["trackdyn", td.__version__]


def test_simulate(folder, recording, drive):
    read = td.read_recording(folder)
    # files keep nine decimals
    for series in ("tracks", "poses", "imu"):
        ours, theirs = getattr(recording, series), getattr(read, series)
        for name, column in ours.items():
            assert np.allclose(column, theirs[name], atol=2e-9, rtol=0.0), (series, name)
    ours = drive.truth
    theirs = np.genfromtxt(folder / "truth.csv", delimiter=",", names=True)
    for name in ("t", "x", "y", "yaw"):
        assert np.allclose(ours[name], theirs[name], atol=1e-6), name


def test_identify(program, folder, robot, tmp_path):
    done = program("identify", folder, "--vehicle", "auriga-alpha", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    for name, alphas in (("kinematics.toml", False), ("kinematics_alpha.toml", True)):
        theirs = td.Parameters(tmp_path / name)
        ours = td.IcrKinematics(robot, alphas=alphas).fit(td.read_recording(folder)).parameters_
        theirs, ours = theirs.to_dict(), ours.to_dict()
        for of in (theirs, ours):
            del of["source"]["command"]
        assert ours == theirs


def test_odometry(program, folder, robot, tmp_path):
    read = td.read_recording(folder)
    fitted = td.IcrKinematics(robot).fit(read.part(runs="0-1"))
    fitted.write(tmp_path)
    replay = td.odometry(read, robot, td.Parameters(tmp_path / "kinematics.toml"), runs=2)
    options = ["--runs", 2, "--vehicle", "auriga-alpha", "--out", tmp_path]
    kinematics = tmp_path / "kinematics.toml"
    done = program("odometry", folder, *options, "--kinematics", kinematics)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "runs.csv").read_text() == replay._inner.runs_csv()
    assert replay.advice == str(kinematics) and replay.reason is None


def test_layers_open_elsewhere(program, folder, tmp_path):
    """Decoders of others read each message; rosbags by its own definitions, to equal bytes."""
    reader = pytest.importorskip("mcap.reader")
    decoder = pytest.importorskip("mcap_ros2.decoder")
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    typesys = pytest.importorskip("rosbags.typesys")
    done = program("odometry", folder, "--gauge", 0.42, "--mcap", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    path = tmp_path / "odometry.mcap"
    for name, of in (("observed", "recorded"), ("ideal", "ideal")):
        files = sorted((tmp_path / "trajectories").glob(f"{of}-run*.tum"))
        expected = np.concatenate([np.loadtxt(file)[:, 1:] for file in files])
        found = []
        with path.open("rb") as file:
            bag = reader.make_reader(file, True, [decoder.DecoderFactory()])
            for decoded in bag.iter_decoded_messages(f"/trackdyn/{name}/pose"):
                pose = decoded.decoded_message.pose
                at, turn = pose.position, pose.orientation
                found.append([at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w])
        assert np.array_equal(np.array(found), expected), name
    types = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
    with rosbag2.Reader(path) as bag:
        topics = {connection.topic for connection in bag.connections}
        for connection, _, raw in bag.messages():
            message = types.deserialize_cdr(raw, connection.msgtype)
            assert bytes(types.serialize_cdr(message, connection.msgtype)) == bytes(raw)
    assert {"/tf", "/trackdyn/tracks", "/trackdyn/ideal/icrs"} <= topics


def test_map(program, tmp_path):
    effect = "load-transfer:cog_height_m=0.3"
    done = program("map", "--effect", effect, "--grid", 11, "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    theirs = td.Parameters(tmp_path / "kinematics.toml").to_dict()
    solved = td.icr_map(td.Vehicle("auriga-alpha", effects=[effect]), points=11)
    ours = solved.parameters.to_dict()
    for of in (theirs, ours):
        del of["source"]["command"]
    assert ours == theirs


def _words(done):
    """What the program says is wrong, without the name of the option in front."""
    assert done.returncode == 1, done.stdout
    return " ".join(done.stderr.split())


@pytest.mark.parametrize(
    ("call", "arguments"),
    [
        (lambda here: td.Vehicle("nonsuch"), ["map", "--vehicle", "nonsuch"]),
        (
            lambda here: td.Vehicle("auriga-alpha", effects=["load-transfer:height=1"]),
            ["map", "--effect", "load-transfer:height=1"],
        ),
        (
            lambda here: td.Vehicle("auriga-alpha", effects=["gravity"]),
            ["map", "--effect", "gravity"],
        ),
        (lambda here: td.Vehicle(here / "bad.toml"), ["map", "--vehicle", "bad.toml"]),
        (
            lambda here: td.read_recording(here / "none.mcap"),
            ["identify", "none.mcap", "--gauge", "0.5"],
        ),
        (lambda here: td.read_recording(here), ["identify", ".", "--gauge", "0.5"]),
        (
            lambda here: td.simulate("auriga-alpha", here / "bad.csv"),
            ["simulate", "--schedule", "bad.csv"],
        ),
        (
            lambda here: td.simulate("auriga-alpha", sensors="eyes"),
            ["simulate", "--sensors", "eyes"],
        ),
        (
            lambda here: td.simulate("auriga-alpha", duration=-1.0),
            ["simulate", "--duration", "-1"],
        ),
    ],
)
def test_errors_have_the_words_of_the_program(program, tmp_path, monkeypatch, call, arguments):
    (tmp_path / "bad.toml").write_text('schema = "trackdyn.vehicle/1"\nname = "x"\nmass_kg = "y"\n')
    (tmp_path / "bad.csv").write_text("t,v_left,v_right\n0,0,0\n1,nan,0\n")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(td.InputError) as raised:
        call(tmp_path)
    said = " ".join(str(raised.value).replace(f"{tmp_path}/", "").split())
    said = said.replace(str(tmp_path), ".")
    if raised.value.setting:
        # the program writes the setting as its option
        said = said.removeprefix(raised.value.setting).lstrip()
    said = said.removeprefix("duration = ")
    assert said in _words(program(*arguments, "--out", "out")), said


@pytest.mark.parametrize(
    ("words", "setting", "call"),
    [
        *(
            (f"identify DRIVE --gauge 0.4 --{name} {value}", name, ("fit", {name: value}))
            for name, value in [
                ("population", 2),
                ("population", 3),
                ("population", 200000),
                ("generations", 0),
                ("generations", 200000),
                ("settle", -1),
                ("settle", "nan"),
            ]
        ),
        ("identify DRIVE --gauge -1", "gauge", ("gauge", -1.0)),
        ("identify DRIVE --gauge 1000", "gauge", ("gauge", 1000.0)),
        ("diagnose DRIVE --vehicle auriga-alpha --draws 3", "draws", ("diagnose", {"draws": 3})),
        ("map --grid 1", "points", ("map", {"points": 1})),
        ("map --grid 3000", "points", ("map", {"points": 3000})),
        ("map --fastest 0", "max_speed", ("map", {"max_speed": 0})),
        ("map --fastest nan", "max_speed", ("map", {"max_speed": np.nan})),
        ("plan --diagnosis none.toml --fastest 100", "fastest", ("plan", {"fastest": 100})),
        # of driving, the crate of schedules says it, which knows no settings
        ("simulate --fastest -1", None, ("simulate", {"fastest": -1})),
        ("simulate --run-count 0", None, ("simulate", {"runs": 0})),
    ],
    ids=lambda of: of if isinstance(of, str) and "-" in of else "",
)
def test_bad_input_is_refused_in_the_same_words(
    program, folder, diagnosis, words, setting, call, tmp_path
):
    what, value = call
    keywords = value if isinstance(value, dict) else {}
    keywords = {key: np.nan if one == "nan" else one for key, one in keywords.items()}
    read = td.read_recording(folder)
    calls = {
        "fit": lambda: td.IcrKinematics(0.4, **keywords).fit(read),
        "gauge": lambda: td.IcrKinematics(value).fit(read),
        "diagnose": lambda: td.diagnose(read, "auriga-alpha", **keywords),
        "map": lambda: td.icr_map("auriga-alpha", **keywords),
        "plan": lambda: td.plan(diagnosis, **keywords),
        "simulate": lambda: td.simulate("auriga-alpha", **keywords),
    }
    with pytest.raises(td.InputError) as raised:
        calls[what]()
    given = [str(folder) if word == "DRIVE" else word for word in words.split()]
    done = program(*given, "--out", tmp_path / "out")
    assert done.returncode in (1, 2), done.stderr
    expected = str(raised.value).split("expected ", 1)[1]
    assert f"expected {expected}" in " ".join(done.stderr.split()), (str(raised.value), done.stderr)
    assert raised.value.setting == setting and str(raised.value).startswith(setting or "")


def test_a_generation_is_enough(program, folder, tmp_path):
    assert td.IcrKinematics(0.42, generations=1, population=4).fit(td.read_recording(folder)).x_r_
    few = ["--generations", 1, "--population", 4, "--out", tmp_path]
    assert program("identify", folder, "--gauge", 0.42, *few).returncode == 0


def test_a_plan_of_what_is_no_diagnosis_says_so(program, diagnosis, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text("a = 1\n")
    with pytest.raises(td.DocumentError, match="other.toml:1") as raised:
        td.plan(other)
    assert "vehicle.corrected.toml" not in str(raised.value)
    assert str(raised.value).splitlines()[0] in program("plan", "--diagnosis", other).stderr
    # a diagnosis without its vehicle
    alone = tmp_path / "diagnosis.toml"
    alone.write_text(diagnosis.to_toml())
    with pytest.raises(td.InputError, match="expected beside the diagnosis, or vehicle"):
        td.plan(alone)

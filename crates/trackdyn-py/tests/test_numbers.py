"""Against NumPy: what the numbers mean."""

import numpy as np
import pytest

import trackdyn as td


@pytest.fixture(scope="module")
def fitted(robot, recording):
    return td.IcrKinematics(robot, alphas=True).fit(recording)


def test_predict_is_the_kinematics_of_the_paper(fitted):
    v_l, v_r = np.random.default_rng(1).uniform(-1.0, 1.0, (2, 7, 5))
    motion = fitted.predict(v_l, v_r)
    assert motion.shape == (7, 5, 3)
    left, right = fitted.alpha_l_ * v_l, fitted.alpha_r_ * v_r
    yaw_rate = (right - left) / (fitted.x_r_ - fitted.x_l_)
    forward = (right + left) / 2 - yaw_rate * (fitted.x_r_ + fitted.x_l_) / 2
    # to the left is minus v_x of the paper, ω y
    expected = np.stack([forward, -yaw_rate * fitted.y_, yaw_rate], axis=-1)
    assert np.allclose(motion, expected, atol=1e-12)
    # (n, 2) is what scikit-learn passes
    both = np.column_stack([v_l.ravel(), v_r.ravel()])
    assert np.array_equal(fitted.predict(both), motion.reshape(-1, 3))
    back = fitted.parameters_.track_speeds(motion[..., 0], motion[..., 2])
    assert np.allclose(back, np.stack([v_l, v_r], axis=-1), atol=1e-12)


def test_the_robot_is_found(robot, fitted):
    # map of the paper's robot: -0.37538, 0.45735, 0.04923 m
    found = np.array([fitted.x_l_, fitted.x_r_, fitted.y_])
    assert np.allclose(found, [-0.37538, 0.45735, 0.04923], atol=0.01)
    assert fitted.covariance_.shape == (5, 5)
    assert np.all(np.linalg.eigvalsh(fitted.covariance_) > 0)
    chi = robot.gauge / (fitted.x_r_ - fitted.x_l_)
    assert fitted.steering_efficiency_ == pytest.approx(chi, abs=1e-9)


def test_score_is_of_the_ends(robot, recording, fitted):
    replay = td.odometry(recording, robot, fitted.parameters_)
    assert replay.sets[0] == "ideal"
    for place in (0, 1):
        ends = []
        for path in replay.paths:
            recorded, predicted = path["recorded"], path[replay.sets[place]]
            ends.append(np.hypot(*(recorded[-1, :2] - predicted[-1, :2])))
        rms = np.sqrt(np.mean(np.square(ends)))
        assert replay.errors_at_end[place, 0] == pytest.approx(rms, rel=1e-9)
    ideal, ours = replay.errors_at_end[:2, 0]
    assert fitted.score(recording) == pytest.approx(1 - (ours / ideal) ** 2)
    assert 0.9 < fitted.score(recording) < 1.0


def test_dead_reckoning_of_the_ideal_drive(robot, recording):
    """Against a path that NumPy adds up, which is good to the steps of the readings."""
    path = td.odometry(recording, robot, runs=0, tau=0.0).paths[0]
    of = recording.part(runs=0).tracks
    t, v_l, v_r = of["t"], of["v_left"], of["v_right"]
    step = np.diff(t)
    turn = np.concatenate([[0.0], np.cumsum((v_r - v_l)[:-1] * step / robot.gauge)])
    turned = path["ideal"][-1, 2] - path["ideal"][0, 2]
    expected = np.interp(path["t"][-1], t, turn) - np.interp(path["t"][0], t, turn)
    # readings hold over 33 ms, at 1 m/s and half a gauge
    assert turned == pytest.approx(expected, abs=0.05 + 0.02 * abs(expected))


def test_map_has_its_means(robot):
    solved = td.icr_map(robot, points=7)
    assert solved.x_l.shape == solved.status.shape == (7, 7)
    turning = solved.status == solved.status_names.index("turning")
    assert np.array_equal(np.isfinite(solved.x_r), turning)
    for name in ("x_l", "x_r", "y"):
        mean = np.nanmean(getattr(solved, name))
        assert solved.statistics[name] == pytest.approx(mean, abs=1e-12)
    # equal speeds stand on the diagonal, and do not turn
    assert not turning.diagonal().any() and turning.sum() == 42
    width = solved.x_r - solved.x_l
    difference = solved.speeds[None, :] - solved.speeds[:, None]
    expected = difference / width
    assert np.allclose(solved.yaw_rate[turning], expected[turning], atol=1e-9)


def test_map_as_xarray(robot):
    dataset = td.icr_map(robot, points=5).to_xarray()
    assert dataset.sizes == {"v_left": 5, "v_right": 5}
    assert dataset["x_r"].attrs["units"] == "m"
    spin = dataset.sel(v_left=-1.0, v_right=1.0)
    assert float(spin["x_r"]) == pytest.approx(0.45735, abs=1e-5)


def test_a_place_matters_to_effects_that_know_it(robot):
    slope = robot.with_effect("slope", angle_deg=10.0)
    up, across = (td.icr_map(slope, points=3, heading=h).statistics["y"] for h in (0.0, 1.57))
    assert abs(up - across) > 1e-3


def test_schedules_of_arrays(robot):
    commands = np.array([[0.0, 0.5, 0.5], [4.0, 0.0, 0.0]])
    straight = td.simulate(robot, commands, sensors="perfect").truth
    # at rest it starts; half a metre per second then
    assert straight["x"][-1] - straight["x"][0] == pytest.approx(2.0, abs=0.05)
    assert abs(straight["yaw"][-1]) < 1e-3
    two = td.simulate(robot, {3: commands, 7: 0.5 * commands + [0.0, 0.0, 0.0]}).recording
    assert two.runs == [3, 7]


def test_steady_points(tmp_path, robot):
    kinematics = td.icr_map(robot).parameters
    speeds = np.array([(a, b) for a in (-0.8, -0.3, 0.4, 0.9) for b in (-0.6, 0.2, 0.7) if a != b])
    rows = np.column_stack([speeds, kinematics.predict(*speeds.T)])
    table = tmp_path / "points.csv"
    head = "v_left,v_right,v_forward,v_lateral,yaw_rate"
    np.savetxt(table, rows, delimiter=",", header=head, comments="")
    points = td.read_recording(table)
    assert points.info["kind"] == "points" and points.points.rows == len(rows)
    fitted = td.IcrKinematics(robot).fit(points)
    assert fitted.x_r_ == pytest.approx(kinematics.x_r, abs=1e-6)


def test_effects_are_the_catalogue(robot):
    catalogue = {effect.id: effect for effect in td.effects()}
    assert len(catalogue) == len(td.effects()) > 20
    for effect in catalogue.values():
        active = robot.with_effect(effect.id).effects
        assert any(one.split(":")[0] == effect.id for one in active)
        for parameter in effect.parameters:
            low, high = parameter.range
            assert low <= parameter.typical <= high

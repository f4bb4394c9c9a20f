"""Laws of a user: effects beside the catalogue, as functions of Python."""

import copy
import math
import pickle
import subprocess
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import lawful
import numpy as np
import pytest
from scipy import interpolate, special

import trackdyn as td

SIZE = {"strength": td.Parameter("N", 7.0)}


def driven(robot, law, **parameters):
    """The true motion of a robot with a law, or without."""
    robot = robot.with_effect(law, **parameters) if law else robot
    return td.simulate(robot, "designed", runs=1, duration=6.0, inertia=False).truth


def off(one, other):
    names = ("x", "y", "yaw", "v_forward", "v_lateral", "yaw_rate")
    return max(np.max(np.abs(one[name] - other[name])) for name in names)


@pytest.mark.parametrize(
    ("law", "twin", "sizes"),
    [
        (lawful.my_turn, "centripetal", {"strength": 0.8}),
        (lawful.my_slow_turn, "centripetal", {"strength": 0.8}),
        (lawful.my_oil, "viscous-friction:growth_s_per_m=0.7", {"growth": 0.7}),
    ],
)
def test_a_copy_of_a_law_moves_as_its_twin(robot, law, twin, sizes):
    copy = driven(robot, law, **sizes)
    own = driven(robot, twin, **(sizes if twin == "centripetal" else {}))
    assert off(copy, own) < 1e-8
    assert off(copy, driven(robot, None)) > 1e-4


def test_what_a_law_is_can_be_asked(robot):
    assert lawful.my_turn.is_compiled and lawful.my_oil.is_compiled
    assert not lawful.my_slow_turn.is_compiled
    breaks = {card.id: card.breaks for card in td.effects()}
    assert lawful.my_turn.breaks == breaks["centripetal"] == lawful.my_slow_turn.breaks
    assert lawful.my_oil.breaks == breaks["viscous-friction"]
    assert lawful.my_turn.summary.startswith("The catalogue's")
    assert repr(lawful.my_oil) == "<Law my-oil(growth), acts as friction, compiled>"
    found = robot.with_effect(lawful.my_oil, growth=0.25)
    assert found.effects == ["my-oil:growth=0.25"] and "[effect.my-oil]" in found._inner.toml
    assert robot.with_effect("my-oil").effects == ["my-oil:growth=0.5"]
    assert td.icr_map(found, points=5)


def everything(at, a, b):
    """What can be traced."""
    swift = np.abs(at.v_forward) > 0.3
    fast = np.where(swift & ~(at.yaw_rate < 0.0), np.tanh(a * at.yaw_rate), b)
    table = np.interp(at.v_left, [-1.0, 0.0, 0.5, 2.0], [3.0, 0.0, -1.0, 4.0])
    force = np.clip(fast + table, -2.0, 2.5) * np.hypot(at.v_lateral, 0.1)
    force += np.sqrt(np.maximum(at.load_left, 0.0)) % 3.0
    force -= np.zeros_like(at.time) + np.sign(at.x) * np.cos(at.heading) ** 2
    return force, np.arctan2(at.y, 1.0 + at.time**2), -force


def test_steps_do_what_the_function_does():
    parameters = {"a": td.Parameter("1", 2.0), "b": td.Parameter("1", 0.3, role="shape")}
    assert td.law("my-everything", parameters=parameters)(everything).is_compiled


def test_what_depends_on_parameters_is_traced_for_each(robot):
    """An interpreter's `if` knows numbers alone."""

    @td.law("my-gear", parameters={"strength": td.Parameter("N s/m", 20.0)})
    def my_gear(at, strength):
        force = np.select([at.v_forward > 0.2, at.v_forward < -0.2], [0.2, -0.2], at.v_forward)
        if strength > 25.0:
            force = np.polyval([math.sqrt(strength), 0.0, 0.0], force)
        return -strength * force, 0.0

    @td.law("my-looked-at-gear", parameters={"strength": td.Parameter("N s/m", 20.0)})
    def looked_at(at, strength):
        return my_gear(SimpleNamespace(v_forward=np.fromiter(at.v_forward, float)), strength)

    assert my_gear.is_compiled and not looked_at.is_compiled
    for strength in (20.0, 30.0, 40.0):
        one, other = (driven(robot, law, strength=strength) for law in (my_gear, looked_at))
        assert off(one, other) < 1e-9


@pytest.mark.parametrize(
    "function",
    [
        lambda at, strength: (np.sort(at.v_forward), 0.0),
        lambda at, strength: (np.fromiter((0.0 * v for v in at.v_forward), float), 0.0),
        lambda at, strength: (at.v_forward - np.mean(at.v_forward), 0.0),
        # what depends on the company of a state is found out
        lambda at, strength: (at.v_forward - sum(at.v_forward), 0.0),
        lambda at, strength: (at.v_forward / len(at.v_forward), 0.0),
        lambda at, strength: (at.v_forward - at.v_forward[0], 0.0),
        lambda at, strength: (at.v_forward * (2.0 if np.any(at.v_forward > 1.0) else 1.0), 0.0),
        lambda at, strength: (np.random.default_rng().random(len(at.time)), 0.0),
    ],
)
def test_what_cannot_be_traced_is_called(function):
    assert not td.law("my-call", parameters=SIZE)(function).is_compiled


PLACES = np.linspace(-3.0, 3.0, 9)
CUBIC = interpolate.CubicSpline(PLACES, np.sin(PLACES))
PCHIP = interpolate.PchipInterpolator(PLACES, np.sin(PLACES))
UNIVARIATE = interpolate.InterpolatedUnivariateSpline(PLACES, np.sin(PLACES))
BSPLINE = interpolate.make_interp_spline(PLACES, np.sin(PLACES))
TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


@np.vectorize
def by_number(v, factor):
    """A function of numbers."""
    if v > 0.3:
        return v * factor
    return max(math.sin(v), -0.2)


def by_masks(at, s):
    force = s * at.v_forward
    is_fast = np.abs(at.yaw_rate) > 0.5
    force[is_fast] *= 2.0
    force[~is_fast] = force[~is_fast] + at.yaw_rate[~is_fast]
    force[at.x > 1.0] = 0.0
    return force, force.copy()


def by_elements(at, s):
    found = np.zeros(len(at.x))
    for k in range(len(at.x)):
        v = at.v_forward[k]
        if v > 1.0:
            found[k] = s * v
        elif v < -1.0:
            found[k] = -1.0
        else:
            found[k] = math.sqrt(abs(v))
    return found, np.array([v if abs(v) < 1.0 else 0.0 for v in at.yaw_rate])


def by_any(at, s):
    """Questions of all states that change nothing for the others."""
    rate = at.yaw_rate
    if np.any(np.abs(rate) > 1.0):
        rate = np.where(np.abs(rate) > 1.0, np.sign(rate), rate)
    if (rate > 1e6).any():
        rate = 2.0 * rate
    return s * rate, 0.0


TRACEABLE = {
    "array": lambda at, s: np.array([at.v_forward, -at.v_lateral]) * s,
    "moment": lambda at, s: np.array([at.v_forward, -at.v_lateral, 0.0 * at.x]),
    "stack": lambda at, s: np.stack([at.x, at.y]) * np.array([[1.0], [2.0]]),
    "norm": lambda at, s: (
        np.linalg.norm([at.v_forward, at.v_lateral], axis=0),
        np.linalg.norm(np.column_stack([at.x, at.y]), axis=1),
    ),
    "product": lambda at, s: TURN @ np.array([at.v_forward, at.v_lateral]),
    "dot": lambda at, s: (
        np.dot([1.0, 2.0], np.vstack([at.x, at.y])),
        np.array([at.x, at.y]).T @ np.array([3.0, 4.0]),
    ),
    "piecewise": lambda at, s: (
        np.piecewise(at.x, [at.x < 0.0, at.x >= 1.0], [lambda v: -v, 3.0, lambda v: v**2]),
        0.0,
    ),
    "round": lambda at, s: (np.round(at.x, 2) + at.x.round(), np.around(at.y, -1)),
    "finite": lambda at, s: (np.where(np.isfinite(at.x), at.x, 0.0), np.nan_to_num(at.x / at.time)),
    "clip": lambda at, s: (at.x.clip(-1.0, 1.0), np.clip(at.y, None, s)),
    "special": lambda at, s: (
        special.erf(at.x) + special.expit(at.y),
        special.xlogy(abs(at.x), abs(at.y) + 1.0) + special.j0(at.time),
    ),
    "math": lambda at, s: (at.x * math.sqrt(s), math.erf(s) * at.x),
    "splines": lambda at, s: (
        CUBIC(at.x) + PCHIP(at.y),
        UNIVARIATE(at.x) + BSPLINE(at.time),
    ),
    "numbers": lambda at, s: (by_number(at.x, s), 0.0),
    "several": lambda at, s: (
        np.maximum.reduce([at.x, at.y, 0.0 * at.x]),
        sum([at.x, at.y]) + np.mean(np.array([at.x, at.y]), axis=0),
    ),
    "if": lambda at, s: (2.0 * at.x if s > 3.0 else at.x * math.log(s), 0.0),
    "masks": by_masks,
    "elements": by_elements,
    "any": by_any,
}


@pytest.mark.parametrize("name", TRACEABLE)
@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value")
def test_what_is_written_with_arrays_is_compiled(name):
    """Compiled laws were compared with their function at many states."""
    size = {"s": td.Parameter("N", 2.0, low=0.1, high=9.0)}
    assert td.law("my-traced", parameters=size)(TRACEABLE[name]).is_compiled


def test_calls_are_shared_by_runs_and_by_points_of_a_map(robot):
    calls = []

    @td.law("my-counted", parameters={"strength": td.Parameter("N s/m", 20.0)})
    def counted(at, strength):
        calls.append(len(at.v_forward))
        return -strength * np.fromiter(at.v_forward, float), 0.0

    own = robot.with_effect(counted)
    numbers = []
    for runs in (1, 8):
        calls.clear()
        many = td.simulate(own, "designed", runs=runs, duration=6.0)
        numbers.append(len(calls))
    assert numbers[1] < 3 * numbers[0], numbers
    # and each run is what it would be alone
    one = td.simulate(own, "designed", runs=1, duration=6.0)
    assert np.array_equal(many.truth["x"][many.truth["run"] == 0], one.truth["x"])
    calls.clear()
    found = td.icr_map(own, points=21)
    assert len(calls) < 441
    twin = td.law("my-twin", parameters={"strength": td.Parameter("N s/m", 20.0)})(
        lambda at, strength: (-strength * at.v_forward, 0.0)
    )
    other = td.icr_map(robot.with_effect(twin), points=21)
    assert np.allclose(found.x_r, other.x_r, rtol=0.0, atol=1e-7, equal_nan=True)


def test_exceptions_come_out_as_they_are(robot):
    class Tired(RuntimeError):
        pass

    @td.law("my-mood", parameters=SIZE)
    def my_mood(at, strength):
        if np.any(np.abs(np.asarray(at.v_forward)) > 0.2) and strength > 8.0:
            raise Tired("not so fast")
        return 0.0 * at.v_forward, 0.0

    moody = robot.with_effect(my_mood, strength=9.0)
    for ask in (lambda: td.simulate(moody, runs=2, duration=5.0), lambda: td.icr_map(moody)):
        with pytest.raises(Tired, match="not so fast"):
            ask()
    assert td.simulate(robot.with_effect(my_mood), runs=1, duration=2.0)
    with pytest.raises(ZeroDivisionError):
        td.law("my-end", parameters=SIZE)(lambda at, strength: 1 // 0)


@pytest.mark.filterwarnings("ignore:invalid value")
def test_what_is_no_result_is_refused_by_law_and_value(robot):
    for adds, said in [
        (lambda at, strength: at.v_forward, "1 results: expected force forward"),
        (lambda at, strength: (at.v_forward, np.zeros(3)), "shape (3,): expected numbers of shape"),
        (lambda at, strength: (at.v_forward, "soft"), "a str: expected numbers"),
        (lambda at, strength: (np.log(at.v_forward - 9.0), 0.0), "forward force NaN at v_forward"),
        (lambda at, strength: (at.pressure, 0.0), "pressure: a law that acts as force"),
    ]:
        with pytest.raises(td.EffectError) as raised, np.errstate(all="ignore"):
            td.law("my-wrong", parameters=SIZE)(adds)
        text = str(raised.value)
        assert said in text, text
        assert "strength" in text and "my-wrong" in text or "pressure" in text, text

    @td.law("my-hole", parameters=SIZE)
    def my_hole(at, strength):
        return strength * np.sqrt(0.9 + at.v_left), 0.0

    with pytest.raises(td.EffectError, match=r"my-hole.*strength = 3.*v_left = -1,.*finite number"):
        td.icr_map(robot.with_effect(my_hole, strength=3.0))


def test_what_no_law_can_be_is_refused(robot):
    def fine(at, strength):
        return 0.0 * at.x, 0.0

    for ask, said in [
        (lambda: td.law("slope", parameters=SIZE)(fine), "an effect of the catalogue"),
        (lambda: td.law("My law", parameters=SIZE)(fine), "small letters"),
        (lambda: td.law("my-law", parameters={})(fine), "strength"),
        (lambda: td.law("my-law", parameters={"strength": 3.0}), "td.Parameter"),
        (lambda: td.law("my-law", parameters=SIZE, acts="magic"), "'force' or 'friction'"),
        (lambda: robot.with_effect(lawful.my_oil, grip=1.0), "expected one of growth"),
        (lambda: robot.with_effect(lawful.my_oil, growth=-1.0), "between 0 and 10"),
        (lambda: td.Vehicle("auriga-alpha").with_effect("my-unknown"), "or a law defined here"),
        (lambda: td.diagnose([], robot, laws="my-unknown"), "as @td.law makes it"),
    ]:
        with pytest.raises(td.InputError) as raised:
            ask()
        assert said in str(raised.value), str(raised.value)


def test_a_file_with_a_law_is_read_where_it_is_defined(robot, program, tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text(robot.with_effect(lawful.my_snow, drag=150.0)._inner.toml)
    assert td.Vehicle(path).effects == ["my-snow:drag=150"]
    done = program("simulate", "--vehicle", path, "--out", tmp_path / "drive")
    assert done.returncode == 1 and "my-snow" in done.stderr, done.stderr
    assert "a law defined here" in done.stderr, done.stderr


def test_a_pickle_brings_the_module_of_its_law(robot, tmp_path):
    snowy = robot.with_effect(lawful.my_snow, drag=150.0)
    assert pickle.loads(pickle.dumps(snowy)) == snowy
    assert pickle.loads(pickle.dumps(lawful.my_snow)) is lawful.my_snow
    (tmp_path / "snowy.pickle").write_bytes(pickle.dumps(snowy))
    code = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).effects)"
    words = [sys.executable, "-c", code, str(tmp_path / "snowy.pickle")]
    here = str(Path(__file__).parent)
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=here)
    assert done.stdout.strip() == "['my-snow:drag=150']", done.stderr


def local_law(width):
    """A law that no other process can import."""

    @td.law("my-local", parameters=SIZE)
    def my_local(at, strength):
        return -strength * np.tanh(at.v_forward / width), 0.0

    return my_local


#: Reads a pickle of a law or a vehicle and drives with it; prints the last place.
DRIVES = """
import pickle, sys, trackdyn as td
law = pickle.load(open(sys.argv[1], "rb"))
robot = td.Vehicle("auriga-alpha").with_effect(law)
truth = td.simulate(robot, "designed", runs=1, duration=6.0, inertia=False).truth
print(repr(float(truth["x"][-1])), law.id, pickle.loads(pickle.dumps(law)) is law)
"""


def elsewhere(code, law, folder):
    """What a process prints that has none of these modules and reads a pickle of a law."""
    (folder / "law.pickle").write_bytes(pickle.dumps(law))
    words = [sys.executable, "-c", code, str(folder / "law.pickle")]
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.parametrize(
    "law",
    [
        local_law(0.2),
        td.law("my-lambda", parameters=SIZE)(lambda at, strength: (-strength * at.v_forward, 0.0)),
        lawful.my_snow,
    ],
)
def test_a_law_goes_to_a_process_that_cannot_import_it(robot, law, tmp_path):
    pytest.importorskip("cloudpickle")
    x, id, is_same = elsewhere(DRIVES, law, tmp_path)
    assert float(x) == driven(robot, law)["x"][-1] and id == law.id and is_same == "True"
    assert pickle.loads(pickle.dumps(law)) is law is copy.deepcopy(law)


def test_a_law_that_was_defined_again_is_sent_again():
    pytest.importorskip("cloudpickle")
    third, first, second = local_law(0.3), local_law(0.2), local_law(0.3)
    assert first.fingerprint != second.fingerprint == third.fingerprint
    old = pickle.dumps(first)
    assert pickle.loads(pickle.dumps(second)) is second
    again = pickle.loads(old)
    assert again.fingerprint == first.fingerprint and again is not second


def test_without_cloudpickle_it_is_said_what_to_do(robot, monkeypatch):
    monkeypatch.setitem(sys.modules, "cloudpickle", None)
    law = local_law(0.2)
    for one in (law, robot.with_effect(law)):
        with pytest.raises(pickle.PicklingError, match="pip install cloudpickle, or define"):
            pickle.dumps(one)
    assert pickle.loads(pickle.dumps(lawful.my_snow)) is lawful.my_snow


def test_what_cannot_be_sent_is_told(robot):
    pytest.importorskip("cloudpickle")
    lock = threading.Lock()

    @td.law("my-lock", parameters=SIZE)
    def my_lock(at, strength):
        with lock:
            return -strength * np.tanh(at.v_forward), 0.0

    with pytest.raises(pickle.PicklingError, match="'my-lock': its function cannot be sent"):
        pickle.dumps(robot.with_effect(my_lock))


def test_workers_of_dask_get_laws_of_modules_that_they_do_not_have(robot, tmp_path, monkeypatch):
    distributed = pytest.importorskip("distributed")
    (tmp_path / "own_helpers.py").write_text("def half(x):\n    return 0.5 * x\n")
    (tmp_path / "own_laws.py").write_text(
        "import own_helpers, trackdyn as td\n"
        "@td.law('own-drag', parameters={'strength': td.Parameter('N s/m', 30.0)})\n"
        "def own_drag(at, strength):\n"
        "    return -strength * own_helpers.half(at.v_forward), 0.0\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    import own_laws

    monkeypatch.undo()
    laws = [own_laws.own_drag, local_law(0.2)]
    robots = [robot.with_effect(law) for law in laws]
    with (
        distributed.LocalCluster(1, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = client.map(td.simulate, robots, runs=1, duration=4.0)
        for one, of in zip(client.gather(found, direct=False), robots):
            expected = td.simulate(of, runs=1, duration=4.0).recording
            assert one.recording.fingerprint == expected.fingerprint


@pytest.fixture(scope="module")
def snow(model):
    """A drive of a robot whose hull ploughs through snow."""
    snowy = model.with_effect(lawful.my_snow, drag=400.0)
    return td.simulate(snowy, runs=1, duration=25.0, sensors="perfect", seed=3).recording


def test_a_suspect_is_named(snow, model):
    found = td.diagnose(snow, model, laws=lawful.my_snow, draws=1000, held_out="none")
    named = {claim.effect: claim for claim in found.claims}
    assert "my-snow" in named, repr(found)
    size = named["my-snow"].sizes[0]
    assert size.name == "drag" and size.value == pytest.approx(400.0, rel=0.2)
    assert any("my-snow" in effect for effect in found.corrected_vehicle.effects)
    assert "my-snow" in found.report() and "my-snow" in found.to_toml()
    same = pickle.loads(pickle.dumps(found))
    assert same.corrected_vehicle == found.corrected_vehicle


def test_a_copy_is_in_the_set_of_its_twin(model):
    """A log that was made with the law of the catalogue."""
    oily = model.with_effect("viscous-friction", growth_s_per_m=0.8)
    log = td.simulate(oily, runs=2, duration=25.0, seed=4).recording
    found = td.diagnose(log, model, laws=[lawful.my_oil], draws=1000, held_out="none")
    twins = [claim for claim in found.claims if "my-oil" in claim.one_of]
    assert twins and "viscous-friction" in twins[0].one_of, repr(found)


def test_a_suspect_that_was_not_there_is_not_named(model):
    log = td.simulate(model, runs=1, duration=25.0, sensors="perfect", seed=5).recording
    found = td.diagnose(log, model, laws=[lawful.my_snow], draws=1000, held_out="none")
    assert all("my-snow" not in claim.one_of for claim in found.claims), repr(found)


def test_python_goes_on_while_a_law_is_called(robot):
    """The interpreter is held during a call only."""
    done = []
    thread = threading.Thread(target=lambda: done.append(driven(robot, lawful.my_slow_turn)))
    thread.start()
    steps = 0
    while thread.is_alive() and steps < 10**7:
        steps += 1
    thread.join()
    assert done and steps > 10

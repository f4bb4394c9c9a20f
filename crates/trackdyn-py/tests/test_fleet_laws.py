"""Laws of a user in a fleet: of vehicles, and as suspects."""

import lawful
import numpy as np
import pytest
from fleets import Inline, rows

import trackdyn as td

pytest.importorskip("cloudpickle")

SIZE = {"strength": td.Parameter("N", 7.0, low=0.0, high=100.0)}


def drag(width):
    """A law that no other process can import, and that depends on a number around it."""

    @td.law("fleet-drag", parameters=SIZE)
    def fleet_drag(at, strength):
        return -strength * np.tanh(at.v_forward / width), 0.0

    return fleet_drag


@pytest.fixture(scope="module")
def logs(model, tmp_path_factory):
    """A log, in a folder of its own."""
    folder = tmp_path_factory.mktemp("lawful")
    snowy = model.with_effect(lawful.my_snow, drag=400.0)
    drive = td.simulate(snowy, runs=1, duration=25.0, seed=3)
    drive.write(folder / "snow")
    return folder


def made(logs, robot, **keywords):
    """What a run did, and its row."""
    # drag looks like wheels of another radius
    keywords["identify"] = {"force": True}
    outcome = td.fleet.run(logs / "snow", robot, logs / "out.parquet", workers=1, **keywords)
    (row,) = rows(logs / "out.parquet").values()
    return outcome, row


def test_a_vehicle_with_a_law_is_made_once(logs, model):
    outcome, row = made(logs, model.with_effect(drag(0.2)), diagnose=False)
    assert row["status"] == "ok", row
    assert outcome.made == {"ok": 1}
    # the law of the same code is the same, and one of another code is another
    assert made(logs, model.with_effect(drag(0.2)), diagnose=False)[0].kept == 1
    outcome, row = made(logs, model.with_effect(drag(0.3)), diagnose=False)
    assert outcome.again == {"of another vehicle": 1} and row["status"] == "ok"


def test_laws_are_suspects(logs, model):
    keywords = {"draws": 1000, "held_out": "none", "laws": [lawful.my_snow]}
    outcome, row = made(logs, model, diagnose=keywords)
    assert row["status"] == "ok", row
    recording = td.read_recording(logs / "snow")
    alone = td.diagnose(recording, model, **keywords)
    assert [one["effect"] for one in row["claims"]] == [claim.effect for claim in alone.claims]
    assert any("my-snow" in one["one_of"] for one in row["claims"])
    assert made(logs, model, diagnose=keywords)[0].kept == 1


def test_another_suspect_is_another_option(logs, model):
    inline = Inline(lambda done: {**done, "row": {"status": "ok", "version": td.__version__}})
    for law, again in [(drag(0.2), None), (drag(0.2), None), (drag(0.3), "with other options")]:
        outcome = td.fleet.run(
            logs / "snow",
            model,
            logs / "options.parquet",
            executor=inline,
            diagnose={"laws": law, "held_out": "none", "draws": 1000},
            timeout=0.5,
        )
        assert again is None or outcome.again == {again: 1}
    assert len(inline.jobs) == 2


def test_a_law_that_cannot_be_sent_is_refused_before_any_work(logs, model):
    import threading

    lock = threading.Lock()

    @td.law("fleet-lock", parameters=SIZE)
    def fleet_lock(at, strength):
        with lock:
            return -strength * np.tanh(at.v_forward), 0.0

    for vehicle, diagnose in [
        (model.with_effect(fleet_lock), False),
        (model, {"laws": fleet_lock}),
    ]:
        with pytest.raises(td.SettingError, match="'fleet-lock': its function cannot be sent"):
            td.fleet.run(logs / "snow", vehicle, logs / "no.parquet", diagnose=diagnose)
    with pytest.raises(td.SettingError, match="as @td.law makes it"):
        td.fleet.run(logs / "snow", model, logs / "no.parquet", diagnose={"laws": "fleet-none"})
    assert not list(logs.glob("no.parquet*"))

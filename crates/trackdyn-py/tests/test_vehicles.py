"""Vehicles of files, names, dicts and numbers."""

import pytest

import trackdyn as td


def test_a_vehicle_is_its_dict(robot):
    for name in td.Vehicle.names():
        vehicle = td.Vehicle(name).with_effect("load-transfer", cog_height_m=0.2)
        same = td.Vehicle(vehicle.to_dict())
        assert same == vehicle and same.fingerprint == vehicle.fingerprint
        assert hash(same) == hash(vehicle) and vehicle != robot


def test_a_vehicle_is_its_file(robot, tmp_path):
    robot.write(tmp_path / "robot.toml")
    assert td.Vehicle(tmp_path / "robot.toml") == robot
    assert td.Vehicle(str(tmp_path / "robot.toml")) == robot
    assert td.Vehicle.from_toml(robot.to_toml()) == robot


def test_a_vehicle_of_numbers():
    numbers = {"gauge": 0.42, "mass": 258.0, "contact_length": 0.7, "width": 0.15}
    tracked = td.Vehicle(**numbers, name="mine", cog=(-0.015, 0.04), friction=(0.9, 0.7))
    paper = td.Vehicle("auriga-alpha").to_dict()
    assert tracked.to_dict() == {**paper, "name": "mine"}
    wheels = td.Vehicle(**{**numbers, "width": 0.1, "contact_length": 0.1}, axles=[0.25, -0.25])
    assert wheels.to_dict()["wheels"]["axles_m"] == [0.25, -0.25]


def test_values_by_their_place(robot):
    other = robot.with_values({"friction.mu_x": 0.5, "effect.load-transfer.cog_height_m": 0.3})
    assert other.to_dict()["friction"] == {"mu_x": 0.5, "mu_y": 0.7}
    assert other.effects == ["load-transfer:cog_height_m=0.3"]
    assert robot.effects == []


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: td.Vehicle(), "not given"),
        (lambda: td.Vehicle(gauge=0.4, mass=1.0), "contact_length, width: not given"),
        (lambda: td.Vehicle("husky-a200", gauge=0.4), "gauge: husky-a200 says it"),
        (
            lambda: td.Vehicle(gauge=-0.4, mass=1.0, contact_length=0.7, width=0.1),
            r"gauge_m = -0.4: expected",
        ),
        (lambda: td.Vehicle({"name": "x", "wheel": 3}), "vehicle:"),
        (lambda: td.Vehicle("auriga-alpha").with_values({"mass_kg": -3.0}), "mass_kg = -3.0"),
        (lambda: td.Vehicle("auriga-alpha").with_cog(0.0, 3.0), "cog"),
    ],
)
def test_what_is_no_vehicle_is_refused(make, words):
    with pytest.raises(td.InputError, match=words):
        make()

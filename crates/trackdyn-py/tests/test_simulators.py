"""Vehicles that the program exports, in the simulators themselves."""

import math

import pytest

import trackdyn as td

PAPER = {"gauge": 0.42, "mass": 258.0, "contact_length": 0.7, "width": 0.15}

ROBOTS = {
    "isotropic": td.Vehicle(**PAPER, cog=(0.0, 0.0), friction=(0.7, 0.7)),
    "anisotropic": td.Vehicle(**PAPER, cog=(0.0, 0.0), friction=(0.9, 0.7)),
    "along": td.Vehicle(**PAPER, cog=(0.0, 0.0), friction=(0.5, 0.8)),
    "shifted": td.Vehicle(**PAPER, cog=(-0.03, 0.08), friction=(0.7, 0.7)),
    "both": td.Vehicle("auriga-alpha").with_values({"cog_m": [-0.015, 0.04]}),
    "split": td.Vehicle("auriga-alpha").with_effect("friction-split", split=0.2),
    "ends": td.Vehicle("auriga-alpha").with_effect("pressure-concentration", concentration=0.6),
    "cohesive": td.Vehicle("auriga-alpha").with_effect("cohesion", stress_pa=4000.0),
    "wheels": td.Vehicle("husky-a200"),
    "small": td.Vehicle(
        gauge=0.15, mass=5.0, contact_length=0.15, width=0.03, cog=(0.0, 0.01), friction=(0.5, 0.7)
    ),
}

# Left and right track speed, m/s. They are slow: the force on the centre of gravity in fast turns
# is real in a simulator, and moves ICRs in trackdyn too.
TURNS = [(-0.2, 0.2), (0.1, 0.3), (0.2, -0.1)]

# A simulator turns with the chi of the vehicle within this.
CHI = 0.05

# ICRs agree within this share of the gauge: friction on an ellipse differs from equation (22).
ICR = 0.05


def exported(program, robot, folder, kind, name):
    robot.write(folder / "robot.toml")
    done = program("export", kind, "--vehicle", folder / "robot.toml", "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder / name


def of_vehicle(program, folder):
    """x_l, x_r, y of the vehicle's map of constants."""
    out = folder / "map"
    vehicle = folder / "robot.toml"
    done = program("map", "--vehicle", vehicle, "--grid", "5", "--out", out)
    assert done.returncode == 0, done.stderr
    parameters = td.Parameters(out / "kinematics.toml")
    return parameters.x_l, parameters.x_r, parameters.y


def turn(mujoco, path, left, right):
    """ICRs x_l, x_r, y of steady motion in MuJoCo."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    names = [model.actuator(k).name for k in range(model.nu)]
    step = model.opt.timestep
    sums, count = [0.0, 0.0, 0.0], 0
    base = model.body("base_link").id
    for k in range(int(1.6 / step)):
        ramp = min(max(k * step - 0.2, 0.0) / 0.3, 1.0)
        data.ctrl[:] = [ramp * (left if name.startswith("left") else right) for name in names]
        mujoco.mj_step(model, data)
        if k * step > 1.0:
            axes = data.xmat[base].reshape(3, 3)
            forward, sideways, _ = axes.T @ data.qvel[:3]
            for at, value in enumerate((forward, sideways, data.qvel[5])):
                sums[at] += value
            count += 1
    forward, sideways, yaw_rate = (value / count for value in sums)
    return (left - forward) / yaw_rate, (right - forward) / yaw_rate, -sideways / yaw_rate


@pytest.mark.parametrize("name", ROBOTS)
def test_mujoco_turns_as_the_vehicle(program, tmp_path, name):
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed")
    robot = ROBOTS[name]
    path = exported(program, robot, tmp_path, "mjcf", "vehicle.mjcf.xml")
    x_l, x_r, y = of_vehicle(program, tmp_path)
    for left, right in TURNS:
        found = turn(mujoco, path, left, right)
        ratio = (found[1] - found[0]) / (x_r - x_l)
        assert abs(ratio - 1.0) < CHI, (left, right, ratio)
        for ours, theirs in zip(found, (x_l, x_r, y)):
            assert abs(ours - theirs) < ICR * robot.gauge, (left, right, found, (x_l, x_r, y))


def test_mujoco_follows_belts_that_change_their_speed(program, tmp_path):
    """The friction of the ground bears 1.5 m/s^2 and no more of a hurry than that of the belts."""
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed")
    path = exported(program, ROBOTS["both"], tmp_path, "mjcf", "vehicle.mjcf.xml")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    base = model.body("base_link").id
    for k in range(int(1.4 / model.opt.timestep)):
        time = k * model.opt.timestep
        belts = 1.5 * (min(max(time - 0.2, 0.0), 0.4) - min(max(time - 0.9, 0.0), 0.4))
        data.ctrl[:] = belts
        mujoco.mj_step(model, data)
        forward = (data.xmat[base].reshape(3, 3).T @ data.qvel[:3])[0]
        assert forward == pytest.approx(belts, abs=0.03), time


def test_mujoco_has_mass_and_belts_of_the_vehicle(program, tmp_path):
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed")
    robot = (
        ROBOTS["both"]
        .with_effect("load-transfer", cog_height_m=0.2)
        .with_effect("yaw-inertia", strength=1.0, gyration_m=0.3)
        .with_effect("encoder-scale", left=0.9, right=1.1)
        .with_effect("drivetrain-lag", time_constant_s=0.5)
        .with_effect("slope", angle_deg=2.0, uphill_deg=90.0)
    )
    path = exported(program, robot, tmp_path, "mjcf", "vehicle.mjcf.xml")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    base = model.body("base_link").id
    assert model.body_subtreemass[base] == pytest.approx(258.0, rel=1e-8)
    assert data.subtree_com[base] == pytest.approx([0.04, 0.015, 0.2], abs=1e-8)
    # I about the vertical through the centre of gravity: m r^2
    moment = sum(
        model.body_inertia[k][2]
        + model.body_mass[k] * sum((data.xipos[k] - data.subtree_com[base])[:2] ** 2)
        for k in range(1, model.nbody)
    )
    assert moment == pytest.approx(258.0 * 0.3**2, rel=0.02)
    slope = math.radians(2.0)
    gravity = [0.0, -9.80665 * math.sin(slope), -9.80665 * math.cos(slope)]
    assert model.opt.gravity == pytest.approx(gravity, rel=1e-6, abs=1e-9)
    # belts: 63 % after the time constant, then the ratio to the encoders
    data.ctrl[:] = 0.1
    speeds = {}
    for k in range(int(4.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
        for at in (0.5, 3.9):
            if k == int(at / model.opt.timestep):
                drives = [model.joint(f"{side}_3_drive").dofadr[0] for side in ("left", "right")]
                radius = model.geom("left_3").size[0]
                speeds[at] = [data.qvel[address] * radius for address in drives]
    assert speeds[3.9] == pytest.approx([0.09, 0.11], rel=0.02)
    assert speeds[0.5] == pytest.approx([0.0569, 0.0695], rel=0.05)


def test_usd_opens_as_an_articulation(program, tmp_path):
    usd = pytest.importorskip("pxr.Usd", reason="usd-core is not installed")
    from pxr import UsdGeom, UsdPhysics, UsdShade  # noqa: PLC0415

    robot = ROBOTS["both"].with_effect("load-transfer", cog_height_m=0.2)
    path = exported(program, robot, tmp_path, "usd", "vehicle.usda")
    stage = usd.Stage.Open(str(path))
    assert UsdGeom.GetStageUpAxis(stage) == "Z" and UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    root = stage.GetDefaultPrim()
    assert root.HasAPI(UsdPhysics.ArticulationRootAPI)
    bodies = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    masses = [UsdPhysics.MassAPI(prim) for prim in bodies]
    mass = [api.GetMassAttr().Get() for api in masses]
    assert sum(mass) == pytest.approx(258.0, rel=1e-6)
    cache = UsdGeom.XformCache()
    places = [
        cache.GetLocalToWorldTransform(prim).Transform(api.GetCenterOfMassAttr().Get())
        for prim, api in zip(bodies, masses)
    ]
    for axis, expected in enumerate((0.04, 0.015, 0.2)):
        mean = sum(m * place[axis] for m, place in zip(mass, places)) / sum(mass)
        assert mean == pytest.approx(expected, abs=1e-6)
    joints = [prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)]
    assert len(joints) == len(bodies) - 1
    for prim in joints:
        joint = UsdPhysics.Joint(prim)
        ends = [
            stage.GetPrimAtPath(target)
            for relation in (joint.GetBody0Rel(), joint.GetBody1Rel())
            for target in relation.GetTargets()
        ]
        assert all(end.HasAPI(UsdPhysics.RigidBodyAPI) for end in ends) and len(ends) == 2
        assert prim.HasAPI(UsdPhysics.DriveAPI, "linear") or prim.HasAPI(
            UsdPhysics.DriveAPI, "angular"
        )
    for prim in bodies[1:]:
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
            friction = UsdPhysics.MaterialAPI(material.GetPrim()).GetDynamicFrictionAttr().Get()
            assert friction == pytest.approx(0.7)

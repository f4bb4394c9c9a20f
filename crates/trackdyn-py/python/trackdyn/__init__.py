"""Tracked robots that slip when they turn.

Simulate them, identify their kinematics from logs, and diagnose which physics a model of them lacks.

>>> import trackdyn as td
>>> robot = td.Vehicle("auriga-alpha")
>>> log = td.simulate(robot, runs=2, seed=1).recording
>>> fitted = td.IcrKinematics(robot).fit(log)
>>> bool(abs(fitted.x_r_ - 0.457) < 0.02)
True

Axes are those of REP-103 (x forward, y left), but for the ICRs, which have those of the paper
(x right, y forward). Units are SI, angles in radians. What goes wrong is a :class:`trackdyn.Error`.
"""

from . import fleet
from ._claims import Claim, Refusal, Size
from ._diagnosis import Diagnosis, diagnose
from ._effects import Effect, EffectParameter, effects
from ._errors import (
    DiagnoseError,
    DocumentError,
    DrivingError,
    EffectError,
    Error,
    HeldOutError,
    IdentifyError,
    InputError,
    NotDeterminedError,
    OdometryError,
    OutputError,
    ParametersError,
    PlanError,
    RecordingError,
    ResultError,
    SettingError,
    SimulateError,
    VehicleError,
    Warning,  # noqa: A004
)
from ._figure import Figure
from ._inspection import Inspection, inspect
from ._kinematics import IcrKinematics
from ._laws import Law, Parameter, Seen, law
from ._map import IcrMap, icr_map
from ._motion_table import MotionTable, motion_table
from ._odometry import Odometry, odometry
from ._parameters import Parameters
from ._plan import Plan, plan
from ._reading import read_recording
from ._recording import Recording
from ._simulation import Simulation, simulate, simulate_batch
from ._tables import Table
from ._trackdyn import VERSION as __version__
from ._vehicle import Vehicle

__all__ = [
    "Claim",
    "DiagnoseError",
    "Diagnosis",
    "DocumentError",
    "DrivingError",
    "Effect",
    "EffectError",
    "EffectParameter",
    "Error",
    "Figure",
    "HeldOutError",
    "IcrKinematics",
    "IcrMap",
    "IdentifyError",
    "InputError",
    "Inspection",
    "Law",
    "MotionTable",
    "NotDeterminedError",
    "Odometry",
    "OdometryError",
    "OutputError",
    "Parameter",
    "Parameters",
    "ParametersError",
    "Plan",
    "PlanError",
    "Recording",
    "RecordingError",
    "Refusal",
    "ResultError",
    "Seen",
    "SettingError",
    "SimulateError",
    "Simulation",
    "Size",
    "Table",
    "Vehicle",
    "VehicleError",
    "Warning",
    "__version__",
    "diagnose",
    "effects",
    "fleet",
    "icr_map",
    "inspect",
    "law",
    "motion_table",
    "odometry",
    "plan",
    "read_recording",
    "simulate",
    "simulate_batch",
]

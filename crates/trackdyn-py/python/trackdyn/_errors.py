"""What goes wrong: one base class, and a class for each kind of error of the library.

Messages are those of the library, word for word: what happened and where, then what was expected.
"""

from __future__ import annotations


class Error(Exception):
    """Base of all errors of trackdyn.

    Attributes
    ----------
    setting : str or None
        The setting that is to be changed, where the message begins with its name.
    """

    def __init__(self, message: str, setting: str | None = None) -> None:
        super().__init__(message, setting)
        self.setting = setting

    def __str__(self) -> str:
        return str(self.args[0])


class InputError(Error, ValueError):
    """An input that cannot be used: a file, a value, or two that do not go together."""


class DocumentError(InputError):
    """A TOML file that is not accepted: names file, line and key."""


class RecordingError(InputError):
    """A recording that cannot be read, or not be used so."""


class HeldOutError(InputError):
    """Runs to hold out that are not there, or that leave none to fit."""


class EffectError(InputError):
    """An effect that the catalogue does not have, or not so."""


class VehicleError(InputError):
    """A vehicle that is neither a name nor a file, or a number that no vehicle has."""


class ParametersError(InputError):
    """Kinematic parameters that cannot be used."""


class DrivingError(InputError):
    """Driving, sensors or a path that cannot be read or used."""


class SettingError(InputError):
    """A keyword whose value is not accepted."""


class ResultError(Error, RuntimeError):
    """Sound input from which no result was found."""


class IdentifyError(ResultError):
    """A recording with too little in it to identify parameters."""


class NotDeterminedError(IdentifyError):
    """A recording that does not determine the ICRs: the message says why."""


class OdometryError(ResultError):
    """A recording that cannot be replayed."""


class DiagnoseError(ResultError):
    """A recording that cannot be diagnosed."""


class PlanError(ResultError):
    """A vehicle for which nothing can be planned, or not so."""


class SimulateError(ResultError):
    """A run that cannot be simulated."""


class OutputError(Error, RuntimeError):
    """A file that cannot be written or replaced."""


class Warning(UserWarning):  # noqa: A001
    """What was cleaned, left out or guessed in reading, and what a result does not show."""


# they are known, and pickled, by the names that users import
for _class in list(globals().values()):
    if isinstance(_class, type) and _class.__module__ == __name__:
        _class.__module__ = "trackdyn"

"""Identification in the manner of scikit-learn."""

from __future__ import annotations

import inspect as _inspect
import os
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _trackdyn, _values
from ._arguments import COMMAND, Progress, gauge_of, recording_of, seed_of, told
from ._errors import NotDeterminedError, ResultError, SettingError, Warning  # noqa: A004
from ._odometry import odometry
from ._parameters import Parameters
from ._recording import Recording
from ._vehicle import VehicleLike


class IcrKinematics:
    """Kinematics of a robot by the ICRs of its tracks, fitted to a recording.

    Follows the manners of scikit-learn (``get_params``, ``set_params``, ``clone``) and does not
    need it.

    Parameters
    ----------
    vehicle : Vehicle, str, path, mapping or float
        The vehicle, or its gauge in m: that is all that counts of it. Default: Auriga-alpha, with
        a warning.
    alphas : bool
        Fit factors on the track speeds beside the ICRs.
    tau : float, optional
        Time by which poses lag behind the track speeds, s. Default: estimated.
    settle : float, optional
        Use only segments before which the tracks ran steadily for this time, s. Default: all.
    nuisances : str or sequence of str
        Properties of the pose sensor to fit beside: ``"time-offset"``, ``"sensor-yaw"``.
    gyroscope : bool
        Correct the yaw of the poses by the recording's gyroscope.
    force : bool
        Give parameters that other parts of the answer contradict as well, marked as doubtful.
    seed : int
        Seed of the genetic algorithm.
    population, generations : int, optional
        Size of the genetic algorithm. Default: those of the library.
    progress : bool or callable
        Show a bar (tqdm), or call with stage, finished parts and all parts.

    Attributes
    ----------
    x_l_, x_r_, y_ : float
        ICRs in the axes of the paper, m: left and right track (right of the centre), and both
        (forward of it).
    alpha_l_, alpha_r_ : float
        Factors from measured to true track speeds; 1 where they were not fitted.
    covariance_ : ndarray of shape (3, 3) or (5, 5)
        Covariance of x_l, x_r, y and, with `alphas`, alpha_l, alpha_r.
    steering_efficiency_ : float
        Gauge over the distance of the ICRs.
    parameters_ : Parameters
        All of it, as a file.
    identification_ : dict
        All that was found, method by method; empty for a table of steady points.
    """

    def __init__(
        self,
        vehicle: VehicleLike | float | None = None,
        *,
        alphas: bool = False,
        tau: float | None = None,
        settle: float | None = None,
        nuisances: str | Sequence[str] = (),
        gyroscope: bool = False,
        force: bool = False,
        seed: int = 1,
        population: int | None = None,
        generations: int | None = None,
        progress: bool | Progress | None = None,
    ) -> None:
        self.vehicle = vehicle
        self.alphas = alphas
        self.tau = tau
        self.settle = settle
        self.nuisances = nuisances
        self.gyroscope = gyroscope
        self.force = force
        self.seed = seed
        self.population = population
        self.generations = generations
        self.progress = progress

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The parameters of the estimator, by name.

        Parameters
        ----------
        deep : bool
            Not used: no parameter is an estimator.

        Returns
        -------
        dict
        """
        names = list(_inspect.signature(type(self).__init__).parameters)[1:]
        return {name: getattr(self, name) for name in names}

    def set_params(self, **params: Any) -> IcrKinematics:
        """Set parameters of the estimator.

        Parameters
        ----------
        **params
            Values by the names of parameters.

        Returns
        -------
        IcrKinematics
            The estimator itself.

        Raises
        ------
        SettingError
            For a name that no parameter has.
        """
        known = self.get_params()
        for name, value in params.items():
            if name not in known:
                raise SettingError(f"{name}: expected one of {', '.join(known)}", name)
            setattr(self, name, value)
        return self

    def fit(self, recording: Recording, y: object = None) -> IcrKinematics:
        """Fit to a recording.

        Parameters
        ----------
        recording : Recording
            Track speeds and poses, or a table of steady points.
        y : None
            Not used.

        Returns
        -------
        IcrKinematics
            The estimator itself.

        Raises
        ------
        NotDeterminedError
            Where the recording does not determine the ICRs: the message says why.
        IdentifyError
            Where it has too little in it.
        """
        keywords = {
            "tau": _values.maybe(_values.finite, "tau", self.tau),
            "settle": _values.maybe(_values.number, "settle", self.settle),
            "nuisances": _values.texts("nuisances", self.nuisances),
            "gyroscope": _values.flag("gyroscope", self.gyroscope),
            "force": _values.flag("force", self.force),
            "seed": seed_of(self.seed),
            "population": _values.maybe(_values.count, "population", self.population),
            "generations": _values.maybe(_values.count, "generations", self.generations),
        }
        place = int(_values.flag("alphas", self.alphas))
        of = recording_of(recording)
        if self.vehicle is None:
            text = "no vehicle given: taken for auriga-alpha; give a vehicle or its gauge"
            warnings.warn(f"{of.place}: {text}", Warning, stacklevel=2)
        gauge = gauge_of(self._vehicle())
        with told(self.progress, "identify") as progress:
            found = _trackdyn.identify(of, gauge, keywords, progress)
        fit = found.fits(COMMAND)[place]
        if fit is None:
            reason = found.reasons[place] or "it tells the distance of the ICRs alone"
            raise NotDeterminedError(f"{of.place}: {reason}")
        self._found = found
        self.parameters_ = Parameters._of(fit)
        self.x_l_, self.x_r_, self.y_, self.alpha_l_, self.alpha_r_ = fit.values
        self.covariance_ = self.parameters_.covariance
        self.steering_efficiency_ = fit.steering_efficiency
        self.identification_: dict[str, Any] = found.document(COMMAND) or {}
        self.contradictions_ = found.contradictions[place]
        self.n_features_in_ = 2
        if self.parameters_.is_doubtful:
            reasons = "; ".join(self.contradictions_)
            warnings.warn(f"{of.place}: {reasons}", Warning, stacklevel=2)
        return self

    def predict(self, v_l: ArrayLike, v_r: ArrayLike | None = None) -> NDArray[np.float64]:
        """Motion of the body at track speeds.

        Parameters
        ----------
        v_l, v_r : array_like
            Speeds of the tracks, m/s, forward positive. Without `v_r`: both, of shape (n, 2).

        Returns
        -------
        ndarray of shape (..., 3)
            Speed forward and to the left (m/s), and yaw rate (rad/s, counter-clockwise).
        """
        if v_r is None:
            both = _values.array("v_l", v_l)
            if both.ndim != 2 or both.shape[1] != 2:
                found = f"an array of shape {both.shape}"
                raise SettingError(f"v_l {found}: expected (n, 2): v_l, v_r; or v_r too", "v_l")
            v_l, v_r = both[:, 0], both[:, 1]
        return self._fitted().predict(v_l, v_r)

    def score(self, recording: Recording, y: object = None) -> float:
        """How much better than the ideal drive the parameters reckon the end of each run.

        Parameters
        ----------
        recording : Recording
            One that was not fitted to.
        y : None
            Not used.

        Returns
        -------
        float
            1 - (e / e0)², of the root mean squares over runs of the errors of place at the end, e
            with these parameters and e0 with the ideal drive: 1 is perfect, 0 no better, negative
            worse.
        """
        replay = odometry(
            recording, self._vehicle(), [self._fitted()], tau=self.tau, gyroscope=self.gyroscope
        )
        ideal, fitted = replay.errors_at_end[0, 0], replay.errors_at_end[1, 0]
        return float(1.0 - (fitted / ideal) ** 2) if ideal > 0.0 else float("nan")

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``kinematics.toml``, ``kinematics_alpha.toml`` and ``identification.toml``.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        self._fitted()
        if self._found is None:
            raise ResultError("an estimator that was unpickled has its parameters_ alone to write")
        return list(self._found.write(_values.path("folder", folder), COMMAND))

    def _vehicle(self) -> VehicleLike | float:
        return "auriga-alpha" if self.vehicle is None else self.vehicle

    def _fitted(self) -> Parameters:
        parameters: Parameters | None = getattr(self, "parameters_", None)
        if parameters is None:
            raise _not_fitted(type(self).__name__)
        return parameters

    def __sklearn_tags__(self) -> Any:
        """What scikit-learn asks for before it checks an estimator."""
        from sklearn.base import BaseEstimator

        return BaseEstimator().__sklearn_tags__()

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "parameters_")

    def __getstate__(self) -> dict[str, Any]:
        state = dict(self.__dict__)
        if "_found" in state:
            state["_found"] = None
        return state

    def __repr__(self) -> str:
        usual = _inspect.signature(type(self).__init__).parameters
        changed = [
            f"{name}={value!r}"
            for name, value in self.get_params().items()
            if not _is_usual(value, usual[name].default)
        ]
        return f"{type(self).__name__}({', '.join(changed)})"

    def _repr_html_(self) -> str:
        from ._html import page

        rows: list[tuple[str, object]] = []
        if hasattr(self, "parameters_"):
            covariance = self.covariance_
            deviations = np.zeros(0) if covariance is None else np.sqrt(np.diag(covariance))
            for name, value, deviation in zip(
                ("x_l", "x_r", "y", "alpha_l", "alpha_r"), self.parameters_._inner.values, deviations
            ):
                rows.append((name, f"{value:.5f} ± {1.96 * deviation:.5f}"))
            rows.append(("steering efficiency", self.steering_efficiency_))
        return page(repr(self), rows)


def _is_usual(value: object, usual: object) -> bool:
    """Whether a parameter has its default; arrays compare to arrays."""
    return value is usual or (type(value) is type(usual) and bool(np.all(value == usual)))


def _not_fitted(name: str) -> Exception:
    """The error of an estimator that is not fitted: that of scikit-learn where it is loaded."""
    import sys

    message = f"This {name} instance is not fitted yet: call 'fit' first"
    learn = sys.modules.get("sklearn.exceptions")
    error: Exception = learn.NotFittedError(message) if learn else ResultError(message)
    return error

"""Diagnoses."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from . import _trackdyn, _values
from ._arguments import (
    COMMAND,
    Progress,
    RunsLike,
    plain,
    recording_of,
    runs_of,
    seed_of,
    text_of_file,
    told,
    vehicle_of,
)
from ._claims import Refusal, claim_of
from ._errors import ResultError
from ._figure import Figure
from ._laws import LawLike, ids_of, of_ids
from ._recording import Recording
from ._vehicle import Vehicle, VehicleLike

if TYPE_CHECKING:
    import pandas


class Diagnosis:
    """What a model of a robot lacks, by recordings of it.

    A pickle holds what the diagnosis says, not what it was made from: figures, report and
    :meth:`write` are those of the diagnosis that was computed here.

    Attributes
    ----------
    claims : tuple of Claim
        What was left out, with sizes and evidence.
    refusals : tuple of Refusal
        What explains the recordings best and is not claimed, with reasons.
    corrected_vehicle : Vehicle
        The vehicle that explains the recordings.
    """

    __slots__ = ("_inner", "_report", "_said", "claims", "corrected_vehicle", "name", "refusals")
    _inner: _trackdyn.Diagnosis | None
    _report: tuple[list[Figure], str] | None

    def __init__(self, inner: _trackdyn.Diagnosis) -> None:
        said = {
            "name": inner.name,
            "toml": inner.toml(COMMAND),
            "kinds": inner.kinds,
            "refusals": inner.refusals,
            "corrected": inner.corrected_vehicle.toml,
            "laws": of_ids(inner.corrected_vehicle.laws),
        }
        self._take(said, inner)

    def _take(self, said: dict[str, Any], inner: _trackdyn.Diagnosis | None) -> None:
        self._inner = inner
        self._report = None
        self._said = said
        self.name: str = said["name"]
        missing = self.to_dict().get("missing", [])
        self.claims = tuple(claim_of(of, kind) for of, kind in zip(missing, said["kinds"]))
        self.refusals = tuple(Refusal(tuple(of), reason) for of, reason in said["refusals"])
        self.corrected_vehicle = Vehicle.from_toml(said["corrected"], "vehicle.corrected.toml")

    @property
    def status(self) -> str:
        """``"explained"``, ``"nothing-missing"``, ``"ambiguous"`` or ``"unexplained"``."""
        return str(self.to_dict()["status"])

    @property
    def where(self) -> str:
        """Where evidence and model differ, in a sentence."""
        return str(self.to_dict()["located"]["where"])

    @property
    def fit(self) -> dict[str, Any]:
        """Errors on held-out runs in units of the noise: before, after, and the floor."""
        return dict(self.to_dict()["fit"])

    @property
    def drift(self) -> dict[str, dict[str, Any]]:
        """Errors of dead reckoning before and after, on the same runs, where enough was driven.

        ``"place_m_per_100_m"`` and ``"yaw_deg_per_turn"``, each with ``"before"``, ``"after"``,
        their 95 % intervals, and what ``"pose_noise"`` alone makes of them.
        """
        return dict(self.to_dict().get("drift", {}))

    @property
    def detectable(self) -> dict[str, dict[str, float]]:
        """Smallest size of each effect that would have been seen, by the keys of its sizes."""
        return dict(self.to_dict().get("detectable", {}))

    @property
    def figures(self) -> list[Figure]:
        """The figures of the report."""
        return list(self._drawn()[0])

    def report(self) -> str:
        """The page with all figures, HTML."""
        return self._drawn()[1]

    def to_dict(self) -> dict[str, Any]:
        """What its file says (schema ``trackdyn.diagnosis/1``)."""
        return _trackdyn.from_toml(self._said["toml"])

    def to_toml(self) -> str:
        """The text of its file."""
        return str(self._said["toml"])

    def to_frame(self) -> pandas.DataFrame:
        """The claims as a frame of pandas, which has to be installed: a row for each size."""
        import pandas

        rows = [
            {
                "claim": number,
                "one_of": " or ".join(claim.one_of),
                "kind": claim.kind,
                "effect": claim.effect,
                "parameter": size.name if size else None,
                "value": size.value if size else float("nan"),
                "low95": size.low if size else float("nan"),
                "high95": size.high if size else float("nan"),
                "unit": size.unit if size else None,
                "p": claim.p,
                "ln_bayes_factor": claim.ln_bayes_factor,
                "held_out_gain": claim.held_out_gain,
            }
            for number, claim in enumerate(self.claims)
            for size in (claim.sizes or (None,))
        ]
        columns = ["claim", "one_of", "kind", "effect", "parameter", "value", "low95", "high95"]
        columns += ["unit", "p", "ln_bayes_factor", "held_out_gain"]
        return pandas.DataFrame(rows, columns=columns)

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``diagnosis.toml``, ``vehicle.corrected.toml``, the report and its figures.

        Layers of an earlier diagnosis go: write them after this.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        return list(self._computed().write(_values.path("folder", folder), COMMAND))

    def write_layers(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``diagnosis.mcap`` for Foxglove, Rerun and PlotJuggler, and layouts.

        In it are paths and ICRs as observed, by the vehicle as given and as corrected, whitened
        residuals before and after, and how the robot drives, as messages of ROS 2.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        return list(self._computed().write_layers(_values.path("folder", folder), COMMAND))

    def _drawn(self) -> tuple[list[Figure], str]:
        """Figures and page, made once."""
        if self._report is None:
            figures, page = self._computed().report(COMMAND)
            self._report = [Figure(figure) for figure in figures], page
        return self._report

    def _computed(self) -> _trackdyn.Diagnosis:
        if self._inner is None:
            raise ResultError(
                f"{self.name}: a diagnosis that was unpickled holds what it says, not what it was "
                "made from: expected figures, report and files before it is pickled"
            )
        return self._inner

    def __getstate__(self) -> dict[str, Any]:
        return self._said

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._take(state, None)

    def __reduce__(self) -> tuple[Any, ...]:
        return object.__new__, (Diagnosis,), self._said

    def __copy__(self) -> Diagnosis:
        made = object.__new__(Diagnosis)
        made._take(self._said, self._inner)
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Diagnosis:
        # nothing of what is shared can be changed
        return self.__copy__()

    def __repr__(self) -> str:
        claims = "; ".join(" or ".join(claim.one_of) for claim in self.claims)
        return f"<Diagnosis of {self.name}: {self.status}{f': {claims}' if claims else ''}>"

    def _repr_html_(self) -> str:
        from ._html import page, table

        fit = self.fit
        rows = [
            ("status", self.status),
            ("where", self.where),
            ("error before", f"{fit['held_out_before']:.3f} times the noise"),
            ("error after", f"{fit['held_out_after']:.3f}, of {fit['noise_floor']:.3f} at least"),
        ]
        units = {"yaw_deg_per_turn": "° of yaw per turn", "place_m_per_100_m": " m per 100 m"}
        rows += [
            ("dead reckoning", f"{of['before']:.3g}{units[key]} before, {of['after']:.3g} after")
            for key, of in self.drift.items()
        ]
        claims = [
            (
                " or ".join(claim.one_of),
                "; ".join(
                    f"{size.name} = {size.value:.4g} [{size.low:.4g}, {size.high:.4g}]"
                    for size in claim.sizes
                ),
                f"{claim.p:.4f}",
                f"{claim.ln_bayes_factor:.1f}",
            )
            for claim in self.claims
        ]
        head = ("missing", "size [95 %]", "p", "ln Bayes factor")
        below = table(head, claims) if claims else ""
        notes = [f"not claimed: {' or '.join(of.one_of)}: {of.reason}" for of in self.refusals]
        return page(f"Diagnosis of {self.name}", rows, notes) + below


def diagnose(
    recordings: Recording | Iterable[Recording],
    vehicle: VehicleLike,
    *,
    settings: Mapping[str, Any] | str | os.PathLike[str] | None = None,
    held_out: RunsLike = None,
    draws: int = 2000,
    seed: int = 1,
    gyroscope: bool = False,
    tau: float | None = None,
    laws: LawLike | Iterable[LawLike] | None = None,
    progress: bool | Progress | None = None,
) -> Diagnosis:
    """Find where model and recordings of a robot differ, and what physics was left out.

    Parameters
    ----------
    recordings : Recording or several
        Recordings of one robot, each once; or one table of steady points.
    vehicle : Vehicle, str, path or mapping
        The vehicle. Its effects are part of the model, and what it says of uncertainties is taken
        as known.
    settings : mapping or path, optional
        Numbers of the method that differ from their defaults, such as
        ``{"verdict": {"max_p": 0.001}}``, or a file with them.
    held_out : str, int or sequence of int, optional
        Runs to judge the result on, such as ``"9-11"``; ``"none"``: none. Default: every fourth run
        where there are eight or more.
    draws, seed : int
        Draws of the bootstrap behind the tests, 1000 to 100000, and their seed.
    gyroscope : bool
        Correct the yaw of the poses by the recordings' gyroscope.
    tau : float, optional
        Time by which poses lag behind the track speeds, s. Default: estimated.
    laws : Law or several, optional
        Suspects beside the catalogue, as :func:`law` makes them. Those that the vehicle has are
        suspects anyway.
    progress : bool or callable
        Show a bar (tqdm), or call with stage, finished parts and all parts.

    Returns
    -------
    Diagnosis

    Raises
    ------
    DiagnoseError
        For too little driving, noise that is not known, or a vehicle that cannot move as recorded.
    """
    single = isinstance(recordings, Recording) or _values.is_single(recordings)
    several: Any = [recordings] if single else recordings
    keywords = keywords_of(
        settings=settings,
        held_out=held_out,
        draws=draws,
        seed=seed,
        gyroscope=gyroscope,
        tau=tau,
        laws=laws,
    )
    with told(progress, "diagnose") as tell:
        recorded = [recording_of(one) for one in several]
        inner = _trackdyn.diagnose(recorded, vehicle_of(vehicle)._inner, keywords, tell)
    return Diagnosis(inner)


def keywords_of(
    *,
    settings: Any = None,
    held_out: RunsLike = None,
    draws: int = 2000,
    seed: int = 1,
    gyroscope: bool = False,
    tau: float | None = None,
    laws: LawLike | Iterable[LawLike] | None = None,
) -> dict[str, Any]:
    """The keywords of :func:`diagnose`, checked, as the library takes them."""
    return {
        "held_out": runs_of(held_out, "held_out"),
        "draws": _values.count("draws", draws),
        "seed": seed_of(seed),
        "gyroscope": _values.flag("gyroscope", gyroscope),
        "tau": _values.maybe(_values.finite, "tau", tau),
        "settings": _settings(settings),
        "laws": ids_of(laws),
    }


def _settings(settings: Mapping[str, Any] | str | os.PathLike[str] | None) -> Any:
    """The name and the text of a settings file."""
    if settings is None:
        return None
    if isinstance(settings, Mapping):
        return "settings", _trackdyn.to_toml(plain(settings))
    return text_of_file(settings, "settings")

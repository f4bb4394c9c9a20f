"""What a run over a fleet did."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas


@dataclass
class Outcome:
    """What a run over a fleet did.

    Attributes
    ----------
    path : Path
        The table.
    logs : int
        Logs that were asked for.
    kept : int
        Rows that were there.
    made : dict of int
        Rows that were made, by status: ``"ok"``, ``"error"``, ``"timed out"``, ``"crashed"``.
    again : dict of int
        Rows that were there and had to be made again, by reason.
    """

    path: Path
    logs: int = 0
    kept: int = 0
    made: Counter[str] = field(default_factory=Counter)
    again: Counter[str] = field(default_factory=Counter)

    @property
    def done(self) -> int:
        """Logs whose row is there."""
        return self.kept + sum(self.made.values())

    def to_frame(self) -> pandas.DataFrame:
        """The table as a frame of pandas, which has to be installed."""
        import pandas

        return pandas.read_parquet(self.path)

    def __str__(self) -> str:
        made = ", ".join(f"{count} {status}" for status, count in sorted(self.made.items()))
        again = ", ".join(f"{count} {reason}" for reason, count in sorted(self.again.items()))
        text = f"{self.done} of {self.logs} logs have a row: {self.kept} were there"
        text = f"{text}, made {made}" if made else text
        return f"{text}; made again: {again}" if again else text

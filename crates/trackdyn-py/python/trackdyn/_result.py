"""Results that pickle: what they say, and what they are made from."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any, ClassVar, TypeVar

_Self = TypeVar("_Self", bound="Result")


class Result:
    """What a function of the library found.

    A pickle holds what the result says, and the arguments that it was made from. What it says is at
    hand at once. Figures and files are computed from the arguments once more, when they are asked
    for.
    """

    __slots__ = ("_computed", "_made_from", "_said")
    #: What the result says, by name: how it is read from what was computed.
    _SAYS: ClassVar[dict[str, Callable[[Any], Any]]] = {}

    def __init__(self, computed: Any, made_from: dict[str, Any]) -> None:
        self._computed = computed
        self._made_from = made_from
        self._said: dict[str, Any] = {}

    @staticmethod
    def _compute(**made_from: Any) -> Any:
        """The result of these arguments, as the extension gives it."""
        raise NotImplementedError

    @property
    def _inner(self) -> Any:
        if self._computed is None:
            self._computed = self._compute(**self._made_from)
        return self._computed

    def _say(self, name: str) -> Any:
        if name in self._said:
            return copy.deepcopy(self._said[name])
        return self._SAYS[name](self._inner)

    def _state(self) -> dict[str, Any]:
        """What subclasses hold beside it."""
        return {}

    def __getstate__(self) -> dict[str, Any]:
        said = {name: self._say(name) for name in self._SAYS}
        return {**self._state(), "_said": said, "_made_from": self._made_from}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._computed = None
        for name, value in state.items():
            setattr(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        return object.__new__, (type(self),), self.__getstate__()

    def __copy__(self: _Self) -> _Self:
        made = object.__new__(type(self))
        for name, value in self._state().items():
            setattr(made, name, copy.copy(value))
        made._computed, made._made_from, made._said = self._computed, self._made_from, self._said
        return made

    def __deepcopy__(self: _Self, memo: dict[int, Any]) -> _Self:
        # nothing of what is shared can be changed
        return self.__copy__()

"""The methods of models by their arguments, with the types of result and of ``out``: for type checkers alone.

At run time each is a ``bgdyn.Method``, and there is no such module.
"""

from typing import Generic, Literal, TypeVar, overload

from ._bgdyn import Mask, Method, Values

_Result = TypeVar("_Result")
_Out = TypeVar("_Out")


class _Q(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QV(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVA(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, a: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, a: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVTau(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, tau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, tau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVATau(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, a: Values, tau: Values = ..., *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, a: Values, tau: Values = ..., *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QQd(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, qd: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, qd: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QQdTau(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, qd: Values, tau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, qd: Values, tau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVAAlong(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, a: Values, dq: Values, dv: Values, da: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, a: Values, dq: Values, dv: Values, da: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVTauAlong(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, tau: Values, dq: Values, dv: Values, dtau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, tau: Values, dq: Values, dv: Values, dtau: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVAL(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, a: Values, l: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, a: Values, l: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

class _QVTauL(Method, Generic[_Result, _Out]):
    @overload  # type: ignore[override]
    def __call__(
        self, q: Values, v: Values, tau: Values, l: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["raise"] = "raise"
    ) -> _Result: ...
    @overload
    def __call__(
        self, q: Values, v: Values, tau: Values, l: Values, *, out: _Out | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[_Result, Mask]: ...

"""What ``help``, ``inspect`` and notebooks read of the methods of models, which are no functions of a class."""

from __future__ import annotations

from collections.abc import Sequence
from inspect import Parameter, Signature
from typing import Any, Generic, TypeVar, overload

from ._bgdyn import Method, Model, class_methods

M = TypeVar("M", covariant=True)


def signature(arguments: Sequence[str], *before: str) -> Signature:
    """Returns the signature of a method with these arguments."""
    places = [Parameter(name, Parameter.POSITIONAL_OR_KEYWORD) for name in (*before, *arguments)]
    options = {"out": None, "threads": 1, "on_singular": "raise"}
    named = [Parameter(name, Parameter.KEYWORD_ONLY, default=value) for name, value in options.items()]
    return Signature([*places, *named])


class _Documentation:
    """``__doc__`` of the class `Method`, and of each method of a model."""

    def __init__(self, of_class: str | None) -> None:
        self.of_class = of_class

    def __get__(self, method: Method | None, owner: type | None = None) -> str | None:
        return self.of_class if method is None else method._documentation


class _Signature:
    """``__signature__`` of each method of a model; the class has none."""

    def __get__(self, method: Method | None, owner: type | None = None) -> Signature:
        if method is None:
            raise AttributeError("__signature__")
        return signature(method.arguments)


class MethodOfClass(Generic[M]):
    """A method on the class `Model`, as ``help`` shows it; on a model it is the `Method` itself."""

    def __init__(self, name: str, arguments: Sequence[str], documentation: str) -> None:
        self.__name__, self.__qualname__, self.__module__ = name, f"Model.{name}", "bgdyn"
        self.__doc__ = documentation
        self.__signature__ = signature(arguments, "self")

    @overload
    def __get__(self, model: None, owner: type | None = None) -> MethodOfClass[M]: ...
    @overload
    def __get__(self, model: Model, owner: type | None = None) -> M: ...
    def __get__(self, model: Model | None, owner: type | None = None) -> Any:
        return self if model is None else model._method(self.__name__)

    def __call__(self, model: Model, *args: Any, **named: Any) -> Any:
        """Calls the method of a model."""
        return model._method(self.__name__)(*args, **named)

    def __repr__(self) -> str:
        return f"<bgdyn.Model.{self.__name__}>"


def document() -> None:
    """Gives the classes of the compiled part what they cannot have by themselves."""
    of_instances = {"__doc__": _Documentation(Method.__doc__), "__signature__": _Signature()}
    for name, found in of_instances.items():
        setattr(Method, name, found)
    for name, arguments, documentation in class_methods():
        of_class: MethodOfClass[Method] = MethodOfClass(name, arguments, documentation)
        setattr(Model, name, of_class)

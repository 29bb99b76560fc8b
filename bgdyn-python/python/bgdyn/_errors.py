"""The exceptions and warnings of the package."""

from __future__ import annotations


class SpecError(ValueError):
    """A file is refused. The text is that of ``bgdyn check``: each fault with its line and the way out."""


class SpecWarning(UserWarning):
    """A file is accepted, but something in it is doubtful. The text is that of ``bgdyn check``."""


class LossWarning(UserWarning):
    """Something in an imported robot was left out, or is doubtful. One line of ``bgdyn import``."""


class SingularError(ArithmeticError):
    """A state has no result: a joint has no inertia left, or a loop is at a singular position.

    ``index`` is the index of the first such state in the leading shape, ``()`` for a single state.
    ``joint`` and ``loop`` name the cause; the one that is not the cause is None.
    """

    def __init__(
        self,
        message: str,
        index: tuple[int, ...] = (),
        joint: str | None = None,
        loop: str | None = None,
    ) -> None:
        super().__init__(message, index, joint, loop)
        self.message = message
        self.index = index
        self.joint = joint
        self.loop = loop

    def __str__(self) -> str:
        return self.message

"""What can go wrong, told so that one knows what to do."""


class AcinusError(Exception):
    """Any error of this package: where, what was found, what to do."""


class NotFound(AcinusError):
    """There is no such run, law or study."""


class Damaged(AcinusError):
    """A file cannot be read although it is there: cut short, changed, or not of this program."""


class BadInput(AcinusError, ValueError):
    """A scene, a value or a call is wrong."""


class FileError(AcinusError, OSError):
    """The program could not read or write a file."""


class CannotContinue(AcinusError, RuntimeError):
    """A simulation could not go on; its state is the last good one."""


class NoSuchItem(AcinusError, KeyError, IndexError):
    """A frame, cell, column or run that is not there."""

    __str__ = Exception.__str__  # KeyError would print quotes

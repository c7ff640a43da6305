class Error(Exception):
    """Something failed: a full disk, a judge that stopped. One line."""


class InputError(Error, ValueError):
    """Input that can be corrected. One line: what, where, what was expected."""


class Warning(UserWarning):
    """What a command would warn of: repaired meshes, sizes that speak for another unit."""

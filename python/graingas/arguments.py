# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a caller's numbers, with messages that name the argument."""
import math
import numbers

from .errors import BadInput


def refused(what, value, allowed):
    return BadInput(f"{what}: {value!r} is not allowed; allowed: {allowed}")


def real(value, what, allowed="a number"):
    """A number as float. Raises TypeError for other types, BadInput for texts, NaN, infinity and numbers that are too
    large.
    """
    if isinstance(value, (str, bytes)):
        raise refused(what, value, allowed)
    try:
        found = float(value)
    except OverflowError:
        raise refused(what, value, allowed) from None
    except (TypeError, ValueError):
        raise TypeError(f"{what}: expected {allowed}, not {type(value).__name__}") from None
    if not math.isfinite(found):
        raise refused(what, value, allowed)
    return found


def whole(value, what, least=0, most=2**63 - 1, allowed=None):
    """A whole number from least to most as int; 3.0 is a whole number."""
    allowed = allowed or f"a whole number of at least {least}"
    found = value if isinstance(value, numbers.Integral) else real(value, what, allowed)
    if isinstance(value, bool) or not least <= found <= most or int(found) != found:
        raise refused(what, value, allowed)
    return int(found)

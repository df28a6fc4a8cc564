# SPDX-License-Identifier: GPL-3.0-or-later
"""pytest on one file: run.py FILE. Exit code 77 (skipped) without pytest."""
import os
import sys

os.environ.pop("COLUMNS", None)  # width of the terminal: the tests expect help texts 80 wide

try:
    import pytest
except ImportError:
    print("skipped: pytest is not installed (Debian: python3-pytest)")
    sys.exit(77)

if __name__ == "__main__":  # processes that tests start import this file
    strict = "error::pytest.PytestUnhandledThreadExceptionWarning"
    sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", "-W", strict, *sys.argv[1:]]))

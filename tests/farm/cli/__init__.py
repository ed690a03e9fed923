"""The command line: exit codes, one clear line, and nothing left behind by a refused command."""

import pytest

# By default pytest explains the asserts of tests and of conftest.py only.
pytest.register_assert_rewrite("tests.farm.cli.result")

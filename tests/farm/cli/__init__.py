"""The command line: exit codes, one clear line, and nothing left behind by a refused command."""

import pytest

# Only tests and conftest.py have their asserts explained unasked.
pytest.register_assert_rewrite("tests.farm.cli.result")

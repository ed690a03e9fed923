"""A copy of the tree for each test."""

from pathlib import Path

import pytest

from tests.how_to.page import Tree


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    """The farm's sources, to be changed."""
    return Tree(tmp_path / "tree")

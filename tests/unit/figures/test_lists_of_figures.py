"""The tables in the docstrings of the packages of figures."""

import re
from importlib import import_module
from pkgutil import iter_modules

import pytest


@pytest.mark.parametrize("name", ["paper_a", "paper_b", "paper_c", "own", "shared"])
def test_a_package_lists_all_its_modules_and_no_others(name):
    package = import_module(f"grainmodes.figures.{name}")
    listed = re.findall(r"^\| `(\w+)` ", package.__doc__, re.MULTILINE)
    assert sorted(listed) == sorted(module.name for module in iter_modules(package.__path__))

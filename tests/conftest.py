"""One thread, a cache of compiled kernels that belongs to the code under test, and the work units.

With pytest-xdist (`make test`) the tests of a file run on one worker, because they share packings
and compiled kernels; so do all tests that use the tiny study of `tests/workflow`, which is built
once.
"""

import pytest

from grainmodes.runtime.environment import prepare

prepare()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Give every test its work unit, and let the long tests of the workflow start first."""
    for item in items:
        unit = "built" if "built" in item.fixturenames else item.nodeid.partition("::")[0]
        item.add_marker(pytest.mark.xdist_group(unit))
    items.sort(key=lambda item: "workflow" not in item.path.parts)

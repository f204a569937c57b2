"""One thread, a cache of compiled kernels that belongs to the code under test, and units of work.

With pytest-xdist (`make test`) the tests of a file run in one process, because they share packings
and compiled kernels. All of `tests/workflow` is one unit, because its tiny study is built once.
"""

import pytest

from grainmodes.runtime.environment import prepare

prepare()


def pytest_collection_modifyitems(items):
    """Let the longest unit, the workflow, start first."""
    items.sort(key=lambda item: "workflow" not in item.path.parts)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Hand out whole files, and the workflow as one unit: `loadgroup` does nothing in pytest 9."""
    from xdist.scheduler import LoadFileScheduling

    class Units(LoadFileScheduling):
        def _split_scope(self, nodeid):
            room = "tests/workflow/"
            return room if nodeid.startswith(room) else super()._split_scope(nodeid)

    return Units(config, log)

"""Long runs: from where they go on, when they are offered to their store, and where they end."""

from dataclasses import dataclass, field

import pytest

from edited_files import flip
from grainmodes.runtime.progress import Progress
from grainmodes.stages.checkpoints import CheckpointFiles
from grainmodes.stages.long_runs import run_to_end


@dataclass
class Counter:
    """A run that counts to `last`; no step is possible from `stuck_at` on."""

    value: int = 0
    last: int = 5
    stuck_at: int = 100
    restartable: bool = True

    @property
    def done(self) -> bool:
        return self.value == self.last

    @property
    def progress(self) -> Progress:
        return Progress(self.value / self.last, "counted", self.value, "numbers")

    def advance(self) -> bool:
        if self.value == self.stuck_at:
            return False
        self.value += 1
        return True


@dataclass
class Store:
    """Holds one saved run, and remembers what it was offered."""

    saved: Counter | None = None
    offered: list[tuple[str, int]] = field(default_factory=list)

    def load(self, name: str) -> Counter | None:
        return self.saved if name == "seed-3" else None

    def save_if_due(self, name: str, run: Counter) -> None:
        self.offered.append((name, run.value))


def refuse() -> Counter:
    raise AssertionError("a run with a checkpoint started from its beginning")


def test_a_run_without_a_store_goes_to_its_end():
    assert run_to_end(Counter, None, "seed-3").value == 5


def test_a_run_goes_on_from_its_checkpoint_and_is_offered_after_every_step():
    store = Store(Counter(value=3))
    assert run_to_end(refuse, store, "seed-3").value == 5
    assert store.offered == [("seed-3", 4), ("seed-3", 5)]


def test_a_run_of_another_name_starts_from_its_beginning():
    store = Store(Counter(value=3))
    run_to_end(Counter, store, "seed-4")
    assert store.offered == [("seed-4", value) for value in range(1, 6)]


@pytest.mark.parametrize("store", [None, Store()], ids=["alone", "with a store"])
def test_a_run_ends_where_no_step_is_possible(store):
    run = run_to_end(lambda: Counter(stuck_at=2), store, "seed-3")
    assert (run.value, run.done) == (2, False)


def test_a_damaged_checkpoint_is_not_read(tmp_path):
    """Many bits of a pickle are numbers that load as other numbers."""
    files = CheckpointFiles(tmp_path / "x.nc", ("start",), -1.0)
    files.load("seed-3")
    files.save_if_due("seed-3", Counter(value=3))
    (path,) = tmp_path.iterdir()
    assert files.load("seed-3") == Counter(value=3)
    whole = path.read_bytes()
    for bit in range(8 * len(whole)):
        flip(path, bit)
        assert files.load("seed-3") is None, bit
        path.write_bytes(whole)
    for kept in range(len(whole)):
        path.write_bytes(whole[:kept])
        assert files.load("seed-3") is None, kept

"""What `snakemake accuracy` runs: a measurement and a picture of every choice."""

import re

import pytest

from measurements.accuracy import NAMES

from .conftest import jobs_in


@pytest.mark.parametrize(
    ("target", "size"),
    [("accuracy", "small"), pytest.param("accuracy_large", "large", marks=pytest.mark.slow)],
)
def test_every_choice_is_measured_and_drawn(fresh, target, size):
    plan = fresh.run("-n", "-p", target)
    count = len(NAMES)
    assert jobs_in(plan) == {target: 1, "measure_accuracy": count, "draw_accuracy": count}
    asked = re.findall(r"measure (\w+) --size (\w+) -o results/accuracy/(\w+)/(\w+)\.csv", plan)
    assert sorted(asked) == sorted((name, size, size, name) for name in NAMES)


@pytest.mark.slow
def test_a_choice_is_measured_anew_when_what_it_calls_is_edited(fresh):
    for name in NAMES:
        for form in ("csv", "png", "pdf"):
            path = fresh.folder / "results" / "accuracy" / "small" / f"{name}.{form}"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch()
    fresh.run("--touch", "accuracy")
    assert fresh.planned("accuracy") == {}
    fresh.edit("protocols/shear/step_strain.py")
    assert fresh.planned("accuracy")["measure_accuracy"] >= 1

"""Six scenes: `snakemake -n` of each shows what it calls for, and nothing else."""

import re

import pytest

from .conftest import SCENE, jobs_in

COMMON = {"compress": 6, "equilibrate": 2, "point": 4, "ensemble": 1}
COMMON |= {"checks": 1, "claims": 1, "passed": 1}
"""What every scene on the tiny grid runs."""

LAW = {"tangential": "smoothed_coulomb", "friction_coefficient": 0.5}
FRICTIONLESS = {"grids": [{"n": [16], "phi": [0.8, 0.85], "seeds": 2}]}

SCENES = {
    "rigidity": ({"rigidity": True}, {}, {"rigidity": 4}),
    "density of states": ({"spectrum": "counts"}, {}, {"spectrum": 4}),
    "eigenvalues": ({"spectrum": "eigenvalues"}, {}, {"spectrum": 4}),
    "shear": ({"shear": True}, {"contact_law": {"normal": "harmonic"}}, {"shear": 4}),
    "release": (
        {"complex_pairs": True, "release": True},
        {"contact_law": LAW},
        {"complex_pairs": 4, "release": 4},
    ),
    "frictionless": (
        {"rigidity": True, "spectrum": "counts"},
        FRICTIONLESS | {"effects": {"friction": False}},
        {"rigidity": 2, "spectrum": 2, "point": 2},
    ),
}
"""Name → observables, other keys, and the jobs that they add."""


SLOW = {"eigenvalues": pytest.mark.slow}
"""Scenes whose path through the workflow another scene takes, too."""


@pytest.fixture(params=[pytest.param(name, marks=SLOW.get(name, ())) for name in SCENES])
def asked(request, fresh):
    """(observables, jobs, plan) of a scene that asks for nothing else and draws what it can."""
    observables, keys, jobs = SCENES[request.param]
    scene = {key: value for key, value in SCENE.items() if key != "figures"} | keys
    nothing = {"rigidity": False, "step_strain": False, "spectrum": "none"}
    grid = scene["grids"][0] | {"observables": nothing | observables}
    fresh.write_scene(scene | {"grids": [grid]})
    return observables, COMMON | jobs, fresh.run("-n", "-p")


def test_a_scene_runs_what_it_calls_for(asked):
    observables, expected, plan = asked
    jobs = jobs_in(plan)
    assert {rule: jobs[rule] for rule in jobs if rule not in ("figure", "film")} == expected
    kinds = set(re.findall(r'"spectrum": "(\w+)"', plan))
    assert kinds == ({observables["spectrum"]} if "spectrum" in observables else set())
    stiffness = set(re.findall(r"--kt (\S+)", plan))
    assert stiffness == ({"0.0"} if expected["point"] == 2 else {"0.0001", "1.0"})

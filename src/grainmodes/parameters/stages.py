"""The table of stages: everything that a study can compute, one entry each.

A stage takes a block of samples and returns a block of samples. From its entry follow

| what                   | where it is made                                                      |
| ---------------------- | --------------------------------------------------------------------- |
| the command            | `cli/arguments/stages.py`: `grainmodes step-strain PACKINGS --kt …`   |
| the settings it sees   | `configuration/scene.py`, `configuration/stage_settings.py`           |
| the rule and its files | `workflow/rules/response.smk`: `results/<study>/step_strain/…`        |
| the key of a scene     | `configuration/schema.py`: `grids.observables.step_strain`            |
| what a point gathers   | `ensemble/point.py`                                                   |
| what a figure may need | `configuration/grids.py`                                              |
| what it costs          | `cost/work.py`, with the growth law of its name in `cost/costs.yaml`  |

To add an observable: its function in `grainmodes.stages`, its entry here, its variables in
`grainmodes.dataset`; then `make handbook`.
"""

from __future__ import annotations

from collections.abc import Iterable

from grainmodes.parameters.spectra import SPECTRA
from grainmodes.parameters.stage import Observables, Stage

WITH_FRICTION = {
    "compression": "protocol.compression",
    "choices": "protocol.frictional_compression",
}
SPECTRUM = {"choices": "protocol.spectrum"}

ENTRIES = (
    Stage(
        "compress",
        "Compress grains to a checkpoint of a trajectory.",
        "grainmodes.stages.compression:compress_block",
        arguments={"compression": "protocol.compression"},
        folder="trajectories",
        reads="compress",
    ),
    Stage(
        "equilibrate",
        "Bring a checkpoint to an area fraction, in force balance.",
        "grainmodes.stages.compression:packing_block",
        arguments={"compression": "protocol.compression"},
        folder="packings",
        reads="compress",
    ),
    Stage(
        "compress_with_friction",
        "Compress grains with friction to a checkpoint of a trajectory (paper B).",
        "grainmodes.stages.frictional_compression:frictional_compress_block",
        arguments=WITH_FRICTION,
        folder="trajectories",
        reads="compress_with_friction",
        needs_friction=True,
    ),
    Stage(
        "equilibrate_with_friction",
        "Bring a checkpoint of a compression with friction to an area fraction, in force balance.",
        "grainmodes.stages.frictional_compression:frictional_packing_block",
        arguments=WITH_FRICTION,
        folder="packings",
        reads="compress_with_friction",
        needs_friction=True,
    ),
    Stage(
        "rigidity",
        "Rigidity from linear response, with its affine and non-affine parts.",
        "grainmodes.stages.rigidity:rigidity_block",
        "rigidity",
        arguments={"rattlers": "protocol.rattlers"},
        default=True,
    ),
    Stage(
        "step_strain",
        "Rigidity from a simulated and relaxed step strain.",
        "grainmodes.stages.step_strain:step_strain_block",
        "step_strain",
        arguments={"rattlers": "protocol.rattlers", "step": "protocol.step_strain"},
        default=True,
    ),
    Stage(
        "spectrum",
        "Spectrum of the Jacobian: numbers of modes in bins (counts), with psi and p of each bin "
        "(binned_averages); every eigenvalue, with psi and p of every eigenvector (modes).",
        "grainmodes.stages.spectrum:spectrum_block",
        "spectrum",
        arguments={"rattlers": "protocol.rattlers", "kind": "observables.spectrum"} | SPECTRUM,
        default="modes",
        kinds=SPECTRA,
        work="spectrum",
        parallel=True,
    ),
    Stage(
        "spectrum_rattlers",
        "The spectrum once more, with the rattlers left in the Jacobian.",
        "grainmodes.stages.spectrum:rattlers_block",
        "rattlers",
        arguments={"kind": "observables.spectrum"} | SPECTRUM,
        work="spectrum",
        parallel=True,
    ),
    Stage(
        "spectrum_hessian",
        "Density of states of the effective Hessian of paper A's Appendix H.",
        "grainmodes.stages.spectrum:hessian_block",
        "hessian",
        arguments={"rattlers": "protocol.rattlers"} | SPECTRUM,
        work="two spectra",
        needs_friction=True,
    ),
    Stage(
        "claim_diagnostics",
        "Measurements that only the claims A1, A12, A16 to A19 and A21 need.",
        "grainmodes.stages.claim_diagnostics:claim_diagnostics_block",
        "claim_diagnostics",
        arguments={"rattlers": "protocol.rattlers", "step": "protocol.step_strain"},
        needs_friction=True,
    ),
    Stage(
        "shear",
        "Quasistatic shear to protocol.shear.strain, with its events (paper B).",
        "grainmodes.stages.shear:shear_block",
        "shear",
        arguments={"choices": "protocol.shear", "coarse_run": "observables.coarse_run"},
        options={
            "coarse_run": "The shear once more, events not bracketed; checks of the first event."
        },
        work="shear",
        resumable=True,
    ),
    Stage(
        "complex_pairs",
        "Complex pairs of eigenvalues along the shear, from birth to death (paper C).",
        "grainmodes.stages.complex_pairs:complex_pairs_block",
        "complex_pairs",
        arguments={"shear": "protocol.shear", "choices": "protocol.complex_pairs"},
        work="steps",
        needs_friction=True,
    ),
    Stage(
        "release",
        "Dynamics from the unstable states of every sample, with and without damping (paper C).",
        "grainmodes.stages.release:release_block",
        "release",
        arguments={"choices": "protocol.release"},
        reads="complex_pairs",
        work="runs",
        needs_friction=True,
        resumable=True,
    ),
    Stage(
        "law_comparison",
        "Complex pairs under every tangential law, to protocol.shear.strain (paper C).",
        "grainmodes.stages.law_comparison:law_comparison_block",
        "law_comparison",
        arguments={"choices": "protocol.shear"},
        work="usual steps",
        needs_friction=True,
        needs_springs_at_rest=True,
    ),
    Stage(
        "fields",
        "Displacement fields and single eigenvectors of the sample of seed 0.",
        "grainmodes.stages.fields:fields_block",
        "fields",
        arguments={"rattlers": "protocol.rattlers", "step": "protocol.step_strain"},
        single_sample=True,
        needs_springs_at_rest=True,
    ),
    Stage(
        "event_detail",
        "The first event of the sample of seed 0, bracketed ever closer (paper B).",
        "grainmodes.stages.event_detail:event_detail_block",
        "event_detail",
        arguments={"choices": "protocol.shear"},
        single_sample=True,
    ),
)

STAGES: dict[str, Stage] = {stage.name: stage for stage in ENTRIES}
"""Name → entry, in the order in which a sample passes them."""


def responses() -> list[Stage]:
    """The stages that a grid can request, each computed from packings that exist."""
    return [stage for stage in STAGES.values() if stage.observable]


def gathered() -> list[Stage]:
    """The stages whose blocks a point gathers, in the order in which names win."""
    return [STAGES["equilibrate"], *responses()]


def packings_stage(preparation: str) -> Stage:
    """The stage that makes the packings of a preparation, one of `PREPARATIONS`."""
    return STAGES["equilibrate" if preparation == "frictionless" else "equilibrate_with_friction"]


def requested(observables: Observables, kt: float) -> list[Stage]:
    """The stages of a point with these observables and this k_T/k_N."""
    return [stage for stage in responses() if stage.is_requested(observables, kt)]


def observable_keys(stages: Iterable[Stage]) -> dict[str, dict[str, object]]:
    """Keys of `grids.observables` → their rules in the schema of a scene."""
    rules: dict[str, dict[str, object]] = {}
    for stage in stages:
        rule: dict[str, object] = {"description": stage.sentence, "default": stage.default}
        rule |= {"enum": list(stage.kinds)} if stage.kinds else {"type": "boolean"}
        rules[stage.observable] = rule
        for option, meaning in stage.options.items():
            rules[option] = {"description": meaning, "type": "boolean", "default": False}
    return rules

"""Commands that join blocks and points, draw figures, and check claims."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from grainmodes.parameters.figures import FIGURES


def gather(arguments: Namespace) -> None:
    """Blocks of one point → the point."""
    from grainmodes.dataset.files import write_block
    from grainmodes.ensemble import gather_point

    write_block(arguments.output, gather_point(arguments.blocks))


def ensemble(arguments: Namespace) -> None:
    """Points → the ensemble."""
    from grainmodes.ensemble import write_ensemble

    write_ensemble(arguments.points, arguments.output, arguments.config)


def figure(arguments: Namespace) -> None:
    """An ensemble, files of single samples, or a reference → one figure."""
    from grainmodes.figures import draw

    given = {name: getattr(arguments, name) for name in ("n", "phi", "kt", "bin_density", "seed")}
    options = {name: value for name, value in given.items() if value is not None}
    draw(arguments.figure, _source(arguments), arguments.output, options)


def _source(arguments: Namespace) -> Path | list[Path]:
    """What the figure is drawn from: files of single samples, or one ensemble.

    Raises:
        ValueError: no data, data beside a reference, or more than one ensemble.
    """
    name, source = arguments.figure, FIGURES[arguments.figure].source
    data = _given_or_reference(arguments, arguments.data)
    if data is None:
        from grainmodes.ensemble import reference

        data = reference.files_of(
            reference.reference_with(name, arguments.reference or None), source
        )
    if source != "ensemble":
        return data
    if len(data) > 1:
        raise ValueError(f"{name}: expected one ensemble, got {len(data)} files")
    return data[0]


def _given_or_reference(arguments: Namespace, given: list[Path]) -> list[Path] | None:
    """The given files, or None where a reference is requested instead.

    Raises:
        ValueError: both, or neither.
    """
    if bool(given) == (arguments.reference is not None):
        got = "both" if given else "neither"
        raise ValueError(f"expected either files or --reference, got {got}")
    return given or None


def _references(study: str) -> list[Path]:
    """The ensemble of the reference of a study, or those of all."""
    from grainmodes.ensemble import reference

    found = [reference.reference_named(study)] if study else reference.references().values()
    return [path for one in found for path in reference.files_of(one, "ensemble")]


def film(arguments: Namespace) -> None:
    """Released samples → the film of one of them."""
    from grainmodes.figures.paper_c import film

    given = {name: getattr(arguments, name) for name in ("n", "phi", "kt", "seed")}
    options = {name: value for name, value in given.items() if value is not None}
    film.write(arguments.data, arguments.output, options)


def claims(arguments: Namespace) -> None:
    """An ensemble, or the references → the verdict on every claim."""
    from grainmodes.claims import first_tested, report

    for path in arguments.outputs:
        report.form(path)
    given = [arguments.ensemble] if arguments.ensemble else []
    ensembles = _given_or_reference(arguments, given) or _references(arguments.reference)
    verdicts, remark = first_tested(ensembles)
    for path in arguments.outputs:
        report.write(verdicts, path, remark)
    if not arguments.outputs:
        print(report.as_text(verdicts, remark), end="")

"""What an entry of the table of stages says; the table itself is `stages`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from grainmodes.parameters.protocol import Protocol

Observables = Mapping[str, bool | str]
"""Key of `grids.observables` → whether it is computed, or which kind of it."""


@dataclass(frozen=True)
class Stage:
    """An entry of the table.

    Attributes:
        name: of its rule and of the attribute `stage` of its blocks; its command has dashes.
        sentence: what it computes, for help texts, messages and the schema.
        function: `module:function` of the package. It is called with the block that it reads, the
            contact law and the keywords of `arguments`.
        observable: key of `grids.observables` that requests it; "" for a stage that others need.
        arguments: keyword of the function → where its value stands in a scene: `protocol.NAME` or
            `observables.NAME`. The stage depends on these values and on the contact law alone.
        default: value of its key where a scene does not say.
        kinds: values of its key that are no booleans; the first one means "not at all".
        options: further boolean keys of `grids.observables` that change what it does → meaning.
        reads: name of the stage whose blocks it takes.
        folder: of its files; its name if empty.
        work: how the number of units of its growth law is counted, as `cost.work.work` does.
        needs_friction: it does not exist at k_T = 0.
        needs_springs_at_rest: it does not exist for packings compressed with friction.
        single_sample: it keeps the grains of the first sample, to be drawn; a point gathers only
            why that sample was lost, if it was.
        parallel: processes can share one sample of it.
        resumable: it saves checkpoints of long samples.
    """

    name: str
    sentence: str
    function: str
    observable: str = ""
    arguments: Mapping[str, str] = field(default_factory=dict)
    default: bool | str = False
    kinds: tuple[str, ...] = ()
    options: Mapping[str, str] = field(default_factory=dict)
    reads: str = "equilibrate"
    folder: str = ""
    work: str = "sample"
    needs_friction: bool = False
    needs_springs_at_rest: bool = False
    single_sample: bool = False
    parallel: bool = False
    resumable: bool = False

    @property
    def command(self) -> str:
        """Its name on the command line."""
        return self.name.replace("_", "-")

    @property
    def title(self) -> str:
        """Its name in a sentence."""
        return self.name.replace("_", " ").capitalize()

    @property
    def output(self) -> str:
        """The folder of its files, and the attribute `stage` of its blocks."""
        return self.folder or self.name

    @property
    def code(self) -> tuple[str, ...]:
        """Entries of `runtime.provenance.stage_sources` whose edit changes its results."""
        return (self.function, *(["grainmodes.stages.checkpoints"] if self.resumable else []))

    def is_requested(self, observables: Observables, kt: float) -> bool:
        """Whether a point with these observables and this k_T/k_N has the stage."""
        if not self.observable or (self.needs_friction and not kt > 0.0):
            return False
        value = observables[self.observable]
        return value != self.kinds[0] if self.kinds else bool(value)

    def parts(self, space: str) -> list[str]:
        """Names of the parts of "protocol" or "observables" that it depends on."""
        paths = (path.partition(".") for path in self.arguments.values())
        return [name for root, _, name in paths if root == space]

    def keywords(self, protocol: Protocol, observables: Observables) -> dict[str, object]:
        """The keywords of its function, with their values in a scene."""
        places = {name: getattr(protocol, name) for name in self.parts("protocol")}
        values = {f"protocol.{name}": value for name, value in places.items()}
        values |= {f"observables.{name}": observables[name] for name in self.parts("observables")}
        return {keyword: values[path] for keyword, path in self.arguments.items()}

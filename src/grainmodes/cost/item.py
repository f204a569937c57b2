"""A row of an estimate, and the jobs that it sums up."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from grainmodes.cost.table import Table


@dataclass(frozen=True)
class Job:
    """What a job costs beyond what every job costs.

    `samples` of it; `seconds`: CPU time of one thread; `megabytes`: its peak; `disk`: bytes that it
    writes; `up_to`: largest N measured, 0 a guess; `shareable`: processes can share its samples.
    """

    samples: int
    seconds: float
    megabytes: float
    disk: float
    up_to: int
    shareable: bool = False

    @classmethod
    def from_units(
        cls,
        table: Table,
        units: Mapping[str, float],
        n: int,
        samples: int,
        disk: float,
        shareable: bool = False,
    ) -> Job:
        """A job whose samples of n grains take so many units of each law and so much disk each."""
        laws = [table.growth_law(name) for name in units]
        seconds = sum(
            times * law.seconds_at(n) for times, law in zip(units.values(), laws, strict=True)
        )
        return cls(
            samples=samples,
            seconds=samples * seconds,
            megabytes=max(law.megabytes_at(n) for law in laws),
            disk=samples * disk,
            up_to=min(law.up_to for law in laws),
            shareable=shareable,
        )


@dataclass(frozen=True)
class Item:
    """What one stage costs at one n of one grid, or of all grids (`grid` None).

    `seconds`: CPU time of all jobs; `chain`: of the longest row of jobs that wait for each other;
    `megabytes`: peak of a job; `disk`: bytes of all files; `up_to`: largest N measured, 0 a guess.
    """

    stage: str
    grid: int | None
    n: int
    samples: int
    jobs: int
    seconds: float
    chain: float
    megabytes: float
    disk: float
    up_to: int

    @classmethod
    def from_chains(
        cls, stage: str, grid: int | None, n: int, chains: Iterable[list[Job]], table: Table
    ) -> Item:
        """The sum over jobs; those of a chain treat the same samples, one job after the other."""
        chains = list(chains)
        jobs = [job for chain in chains for job in chain]
        start_up, file = table.job["seconds"], table.disk["file"]
        lengths = [sum(job.seconds + start_up for job in chain) for chain in chains]
        return cls(
            stage=stage,
            grid=grid,
            n=n,
            samples=sum(chain[0].samples for chain in chains),
            jobs=len(jobs),
            seconds=sum(lengths),
            chain=max(lengths),
            megabytes=table.job["megabytes"] + max(job.megabytes for job in jobs),
            disk=sum(job.disk + file for job in jobs),
            up_to=min(job.up_to for job in jobs),
        )

"""A row of an estimate, and the jobs that it sums up."""

from __future__ import annotations

from dataclasses import dataclass

from grainmodes.cost.table import GrowthLaw, Table


@dataclass(frozen=True)
class Job:
    """A job beyond what every job costs: its samples, CPU seconds, and bytes on disk."""

    samples: int
    seconds: float
    disk: float


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
        cls,
        stage: str,
        grid: int | None,
        n: int,
        chains: list[list[Job]],
        laws: list[GrowthLaw],
        table: Table,
    ) -> Item:
        """The sum over jobs; those of a chain treat the same samples, one job after the other."""
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
            megabytes=table.job["megabytes"] + max(law.megabytes_at(n) for law in laws),
            disk=sum(job.disk + file for job in jobs),
            up_to=min(law.up_to for law in laws),
        )

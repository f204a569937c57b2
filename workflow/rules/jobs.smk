# What a job needs, by the growth law of its stage, and where it leaves its log and its benchmark.

from grainmodes.cost import resources
from grainmodes.parameters.grid import Point, parse_seeds

LOGS = f"logs/{scene.study}"


def log_of(rule, file=""):
    """Where a job keeps what it prints; its benchmark lies beside it.

    Neither lies among the results, whose bytes are the same in every run.
    """
    return f"{LOGS}/{rule}{'/' if file else ''}{file.removesuffix('.nc')}.log"


def benchmark_of(rule, file=""):
    """Where Snakemake writes what a job took: time, memory, disk."""
    return f"{log_of(rule, file).removesuffix('.log')}.tsv"


def job_of_stage(name):
    """Wildcards → what the job of a stage costs; packings without friction have no k_T."""
    single = STAGES[name].single_sample

    def job(wildcards):
        point = Point(int(wildcards.n), float(wildcards.phi), float(wildcards.get("kt", 0.0)))
        samples = 1 if single else len(parse_seeds(wildcards.seeds))
        return resources.stage_job(scene, COSTS, name, point, samples)

    return job


def job_of_point(wildcards):
    """What it costs to gather a point."""
    files = len(blocks_of_point(wildcards))
    return resources.gather_job(scene, COSTS, [Point(*point_of(wildcards))], files)


def job_of_ensemble(wildcards):
    """What it costs to gather all points."""
    return resources.gather_job(scene, COSTS, scene.points, len(scene.points))


def job_of_reader(wildcards):
    """What it costs to read the ensemble."""
    return resources.reader_job(scene, COSTS)


def job_of_measurement(n, seconds):
    """Wildcards → what it costs to measure speeds up to n grains, for so long."""
    return lambda wildcards: resources.measurement_job(COSTS, n, seconds)


def threads_for(job):
    """`threads` of a rule whose jobs cost so much."""
    return lambda wildcards: resources.threads(job(wildcards))


def needs(job):
    """`resources` of a rule whose jobs cost so much; twice as much at every further attempt."""
    return {
        "mem_mb": lambda wildcards, threads, attempt: resources.megabytes(
            job(wildcards), COSTS, threads, attempt
        ),
        "runtime": lambda wildcards, threads, attempt: resources.minutes(
            job(wildcards), COSTS, threads, attempt
        ),
    }

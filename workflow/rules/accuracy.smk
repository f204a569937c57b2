# Work-precision diagrams: what each numerical choice costs in CPU time, and the error it leaves.

DIAGRAM = "results/accuracy/{size}/{name}"
SHARED = (
    *("diagram", "growth_rate", "kernel_polynomial", "loops", "packings"),
    *("refined_modes", "table"),
)
# The largest N of a diagram, and about how many CPU seconds it takes.
EFFORT = {"small": (1024, 1800), "large": (65536, 8 * 3600)}


wildcard_constraints:
    name="|".join(NAMES),
    size="small|large",


def job_of_accuracy(wildcards):
    """What it costs to measure a diagram."""
    return resources.measurement_job(COSTS, *EFFORT[wildcards.size])


rule accuracy:
    input:
        expand(f"{DIAGRAM}.{{form}}", size="small", name=NAMES, form=["png", "pdf"]),


rule accuracy_large:
    input:
        expand(f"{DIAGRAM}.{{form}}", size="large", name=NAMES, form=["png", "pdf"]),


rule measure_accuracy:
    input:
        script=source("measurements/accuracy/measure.py"),
        code=lambda wildcards: sources_of_accuracy(*SHARED, wildcards.name),
    output:
        f"{DIAGRAM}.csv",
    log:
        "logs/accuracy/{size}/{name}.log",
    benchmark:
        "logs/accuracy/{size}/{name}.tsv"
    resources:
        **needs(job_of_accuracy),
    message:
        "Measure cost and error of {wildcards.name}, {wildcards.size}."
    shell:
        "python -m measurements.accuracy.measure {wildcards.name} --size {wildcards.size} -o {output}"
        " 2>&1 | tee {log} >&2"


rule draw_accuracy:
    input:
        script=source("measurements/accuracy/draw.py"),
        table=f"{DIAGRAM}.csv",
        code=sources_of_accuracy("diagram", "panels", "table"),
        style=sources("grainmodes.figures"),
    output:
        [f"{DIAGRAM}.{form}" for form in ("png", "pdf")],
    log:
        "logs/draw_accuracy/{size}/{name}.log",
    benchmark:
        "logs/draw_accuracy/{size}/{name}.tsv"
    resources:
        **needs(job_of_reader),
    params:
        stem=stem_of_outputs,
    message:
        "Draw {wildcards.name}, {wildcards.size}."
    shell:
        "python -m measurements.accuracy.draw {input.table} -o {params.stem}"
        " 2>&1 | tee {log} >&2"

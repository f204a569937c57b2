# Work-precision diagrams: what each numerical choice costs in CPU time, and the error it leaves.

DIAGRAM = "results/accuracy/{size}/{name}"
SHARED = (
    *("diagram", "growth_rate", "kernel_polynomial", "loops", "packings"),
    *("refined_modes", "table"),
)


wildcard_constraints:
    name="|".join(NAMES),
    size="small|large",


rule accuracy:
    input:
        expand(f"{DIAGRAM}.{{form}}", size="small", name=NAMES, form=["png", "pdf"]),


rule accuracy_large:
    input:
        expand(f"{DIAGRAM}.{{form}}", size="large", name=NAMES, form=["png", "pdf"]),


rule measure_accuracy:
    input:
        script="measurements/accuracy/measure.py",
        code=lambda wildcards: sources_of_accuracy(*SHARED, wildcards.name),
    output:
        f"{DIAGRAM}.csv",
    message:
        "Measure cost and error of {wildcards.name}, {wildcards.size}."
    shell:
        "python -m measurements.accuracy.measure {wildcards.name} --size {wildcards.size} -o {output}"


rule draw_accuracy:
    input:
        script="measurements/accuracy/draw.py",
        table=f"{DIAGRAM}.csv",
        code=sources_of_accuracy("diagram", "panels", "table"),
        style=sources("grainmodes.figures"),
    output:
        [f"{DIAGRAM}.{form}" for form in ("png", "pdf")],
    params:
        stem=DIAGRAM,
    message:
        "Draw {wildcards.name}, {wildcards.size}."
    shell:
        "python -m measurements.accuracy.draw {input.table} -o {params.stem}"

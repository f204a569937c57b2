# The ensemble -> pictures, and the plotted numbers beside them.


rule figure:
    input:
        ensemble=rules.ensemble.output,
        code=sources_of_figure,
    output:
        [f"{STUDY}/figures/{{figure}}.{form}" for form in FORMS],
    wildcard_constraints:
        figure="|".join(FIGURES),
    params:
        stem=f"{STUDY}/figures/{{figure}}",
    message:
        "Draw {wildcards.figure}."
    shell:
        "grainmodes figure {wildcards.figure} {input.ensemble} -o {params.stem}"

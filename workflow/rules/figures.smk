# The ensemble, and files of single samples -> pictures, with plotted numbers and caption beside them.


rule film:
    input:
        data=samples_of("release"),
        code=sources("grainmodes.figures.paper_c.film"),
    output:
        f"{STUDY}/figures/release_spirals.gif",
    message:
        "Draw the spirals of a released sample as a film."
    shell:
        "grainmodes film {input.data} -o {output}"


rule figure:
    input:
        data=data_of_figure,
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
        "grainmodes figure {wildcards.figure} {input.data} -o {params.stem}"

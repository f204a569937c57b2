# The ensemble, and files of single samples -> pictures, with plotted numbers and caption beside them.


rule film:
    input:
        data=samples_of("release"),
        code=sources("grainmodes.figures.paper_c.film"),
    output:
        f"{STUDY}/figures/release_spirals.gif",
    log:
        log_of("film"),
    benchmark:
        benchmark_of("film")
    resources:
        **needs(job_of_reader),
    message:
        "Draw the spirals of a released sample as a film."
    shell:
        "grainmodes film {input.data} -o {output} 2>&1 | tee {log} >&2"


rule figure:
    input:
        data=data_of_figure,
        code=sources_of_figure,
    output:
        [f"{STUDY}/figures/{{figure}}.{form}" for form in FORMS],
    log:
        log_of("figure", "{figure}"),
    benchmark:
        benchmark_of("figure", "{figure}")
    wildcard_constraints:
        figure="|".join(FIGURES),
    resources:
        **needs(job_of_reader),
    params:
        stem=stem_of_outputs,
    message:
        "Draw {wildcards.figure}."
    shell:
        "grainmodes figure {wildcards.figure} {input.data} -o {params.stem} 2>&1 | tee {log} >&2"

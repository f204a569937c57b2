# The ensemble -> a verdict on every claim of the papers, as a page and as a table.


rule claims:
    input:
        ensemble=rules.ensemble.output,
        code=sources(
            "grainmodes.claims",
            "grainmodes.claims.report",
            "grainmodes.ensemble:open_ensemble",
        ),
    output:
        page=f"{STUDY}/claims.md",
        table=f"{STUDY}/claims.csv",
    log:
        log_of("claims"),
    benchmark:
        benchmark_of("claims")
    resources:
        **needs(job_of_reader),
    message:
        "Check the claims of the papers."
    shell:
        "grainmodes claims {input.ensemble} -o {output.page} {output.table} 2>&1 | tee {log} >&2"

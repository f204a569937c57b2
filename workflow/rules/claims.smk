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
    message:
        "Check the claims of the papers."
    shell:
        "grainmodes claims {input.ensemble} -o {output.page} {output.table}"

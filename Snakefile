# From grains at random to averaged figures.
#
#   snakemake -j2                                       the scene of config/default.yaml
#   snakemake -j2 --configfile config/paper_a.yaml      another scene, instead of the default one
#   snakemake -n                                        what would run
#   snakemake -j1 results/default/rigidity/n~256/phi~0.873/kt~3e-05/seeds~0003-0003.nc
#   snakemake -j1 benchmarks                            a table of speeds
#   snakemake -j2 accuracy                              what each numerical choice costs and buys
#
# trajectories -> packings -> the stages of grainmodes.parameters.stages -> points -> ensemble
#                          \-> stages of a single sample -> figures       ensemble -> figures, claims


include: "workflow/rules/scene.smk"
include: "workflow/rules/common.smk"
include: "workflow/rules/jobs.smk"
include: "workflow/rules/packings.smk"
include: "workflow/rules/response.smk"
include: "workflow/rules/ensembles.smk"
include: "workflow/rules/checks.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/benchmarks.smk"
include: "workflow/rules/accuracy.smk"


rule all:
    default_target: True
    input:
        ensemble=rules.ensemble.output,
        checks=rules.checks.output,
        passed=rules.passed.output,
        claims=rules.claims.output,
        samples=[samples_of(stage.name) for stage in responses() if stage.single_sample],
        figures=figures(),

# Blocks of seeds -> points of the grids -> one ensemble.


rule point:
    input:
        blocks=blocks_of_point,
        code=sources("grainmodes.ensemble:gather_point"),
    output:
        f"{STUDY}/points/{POINT}",
    log:
        log_of("point", POINT),
    benchmark:
        benchmark_of("point", POINT)
    resources:
        **needs(job_of_point),
    message:
        "Gather n = {wildcards.n}, phi = {wildcards.phi}, k_T = {wildcards.kt}."
    shell:
        "grainmodes gather {input.blocks} -o {output} 2>&1 | tee {log} >&2"


rule ensemble:
    input:
        points=files_of("points", scene.points),
        code=sources("grainmodes.ensemble:write_ensemble"),
    output:
        f"{STUDY}/ensemble.nc",
    log:
        log_of("ensemble"),
    benchmark:
        benchmark_of("ensemble")
    resources:
        **needs(job_of_ensemble),
    params:
        config=scene.summary(),
    message:
        "Gather all points into one ensemble."
    shell:
        "grainmodes ensemble {input.points} --config {params.config:q} -o {output}"
        " 2>&1 | tee {log} >&2"

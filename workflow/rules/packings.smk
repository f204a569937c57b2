# Grains at random -> checkpoints of a compression -> packings in force balance.


rule compress:
    input:
        start=checkpoint_below,
        code=sources(*STAGES["compress"].code),
    output:
        f"{STUDY}/trajectories/{BLOCK}",
    log:
        log_of("compress", BLOCK),
    benchmark:
        benchmark_of("compress", BLOCK)
    priority: 2  # everything else waits for the trajectories
    resources:
        **needs(job_of_stage("compress")),
    params:
        settings=scene.settings("compress"),
    message:
        "Compress {wildcards.n} grains to phi = {wildcards.phi} (seeds {wildcards.seeds})."
    shell:
        "grainmodes compress --n {wildcards.n} --phi {wildcards.phi} --seeds {wildcards.seeds}"
        " --start {input.start} --settings {params.settings:q} -o {output}"
        " 2>&1 | tee {log} >&2"


rule equilibrate:
    input:
        start=checkpoint_for,
        code=sources(*STAGES["equilibrate"].code),
    output:
        f"{STUDY}/packings/{BLOCK}",
    log:
        log_of("equilibrate", BLOCK),
    benchmark:
        benchmark_of("equilibrate", BLOCK)
    priority: 1
    resources:
        **needs(job_of_stage("equilibrate")),
    params:
        settings=scene.settings("equilibrate"),
    message:
        "Balance {wildcards.n} grains at phi = {wildcards.phi} (seeds {wildcards.seeds})."
    shell:
        "grainmodes equilibrate {input.start} --phi {wildcards.phi}"
        " --settings {params.settings:q} -o {output}"
        " 2>&1 | tee {log} >&2"


rule compress_with_friction:
    input:
        start=frictional_checkpoint_below,
        code=sources(*STAGES["compress_with_friction"].code),
    output:
        f"{STUDY}/trajectories/{RESPONSE}",
    log:
        log_of("compress_with_friction", RESPONSE),
    benchmark:
        benchmark_of("compress_with_friction", RESPONSE)
    priority: 2
    resources:
        **needs(job_of_stage("compress_with_friction")),
    params:
        settings=scene.settings("compress_with_friction"),
    message:
        f"Compress with friction {AT}."
    shell:
        "grainmodes compress-with-friction --n {wildcards.n} --phi {wildcards.phi}"
        " --kt {wildcards.kt} --seeds {wildcards.seeds} --start {input.start}"
        " --settings {params.settings:q} -o {output}"
        " 2>&1 | tee {log} >&2"


rule equilibrate_with_friction:
    input:
        start=frictional_checkpoint_for,
        code=sources(*STAGES["equilibrate_with_friction"].code),
    output:
        f"{STUDY}/packings/{RESPONSE}",
    log:
        log_of("equilibrate_with_friction", RESPONSE),
    benchmark:
        benchmark_of("equilibrate_with_friction", RESPONSE)
    priority: 1
    resources:
        **needs(job_of_stage("equilibrate_with_friction")),
    params:
        settings=scene.settings("equilibrate_with_friction"),
    message:
        f"Balance with friction {AT}."
    shell:
        "grainmodes equilibrate-with-friction {input.start} --phi {wildcards.phi}"
        " --kt {wildcards.kt} --settings {params.settings:q} -o {output}"
        " 2>&1 | tee {log} >&2"

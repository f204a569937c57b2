# Grains at random -> checkpoints of a compression -> packings in force balance.


rule compress:
    input:
        start=checkpoint_below,
        code=sources(*STAGES["compress"].code),
    output:
        f"{STUDY}/trajectories/{BLOCK}",
    priority: 2  # everything else waits for the trajectories
    params:
        settings=scene.settings("compress"),
    message:
        "Compress {wildcards.n} grains to phi = {wildcards.phi} (seeds {wildcards.seeds})."
    shell:
        "grainmodes compress --n {wildcards.n} --phi {wildcards.phi} --seeds {wildcards.seeds}"
        " --start {input.start} --settings {params.settings:q} -o {output}"


rule equilibrate:
    input:
        start=checkpoint_for,
        code=sources(*STAGES["equilibrate"].code),
    output:
        f"{STUDY}/packings/{BLOCK}",
    priority: 1
    params:
        settings=scene.settings("equilibrate"),
    message:
        "Balance {wildcards.n} grains at phi = {wildcards.phi} (seeds {wildcards.seeds})."
    shell:
        "grainmodes equilibrate {input.start} --phi {wildcards.phi}"
        " --settings {params.settings:q} -o {output}"


rule compress_with_friction:
    input:
        start=frictional_checkpoint_below,
        code=sources(*STAGES["compress_with_friction"].code),
    output:
        f"{STUDY}/trajectories/{RESPONSE}",
    priority: 2
    params:
        settings=scene.settings("compress_with_friction"),
    message:
        f"Compress with friction {AT}."
    shell:
        "grainmodes compress-with-friction --n {wildcards.n} --phi {wildcards.phi}"
        " --kt {wildcards.kt} --seeds {wildcards.seeds} --start {input.start}"
        " --settings {params.settings:q} -o {output}"


rule equilibrate_with_friction:
    input:
        start=frictional_checkpoint_for,
        code=sources(*STAGES["equilibrate_with_friction"].code),
    output:
        f"{STUDY}/packings/{RESPONSE}",
    priority: 1
    params:
        settings=scene.settings("equilibrate_with_friction"),
    message:
        f"Balance with friction {AT}."
    shell:
        "grainmodes equilibrate-with-friction {input.start} --phi {wildcards.phi}"
        " --kt {wildcards.kt} --settings {params.settings:q} -o {output}"

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

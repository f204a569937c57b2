# Grains at random -> checkpoints of a compression -> packings in force balance.


rule compress:
    input:
        start=checkpoint_below,
        code=sources("grainmodes.stages.packings:compress_block"),
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
        code=sources("grainmodes.stages.packings:packing_block"),
    output:
        f"{STUDY}/packings/{BLOCK}",
    priority: 1
    params:
        settings=scene.settings("compress"),
    message:
        "Balance {wildcards.n} grains at phi = {wildcards.phi} (seeds {wildcards.seeds})."
    shell:
        "grainmodes equilibrate {input.start} --phi {wildcards.phi}"
        " --settings {params.settings:q} -o {output}"

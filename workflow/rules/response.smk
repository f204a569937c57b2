# Packings -> what the table of stages computes from them, each for one k_T: a rule for each entry.


def command_of(stage):
    """The command of a rule: every stage takes the same arguments."""
    processes = " --processes {threads}" if stage.parallel else ""
    return (
        f"grainmodes {stage.command} {{input.block}} --kt {{wildcards.kt}}{processes}"
        " --settings {params.settings:q} -o {output}"
    )


for stage in responses():

    rule:
        name:
            stage.name
        input:
            block=block_read_by(stage),
            code=sources(*stage.code),
        output:
            f"{STUDY}/{stage.output}/{POINT if stage.single_sample else RESPONSE}",
        params:
            settings=settings_of(stage),
        message:
            f"{stage.title} at {AT_POINT if stage.single_sample else AT}."
        shell:
            command_of(stage)

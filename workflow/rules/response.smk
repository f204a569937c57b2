# Packings -> what the table of stages computes from them, each for one k_T: a rule for each entry.
#
# Snakemake evaluates `shell` when a job runs, after the loop has ended, so that it must not name the
# variable of the loop; params are evaluated here.

for stage in responses():
    if stage.parallel:

        rule:
            name:
                stage.name
            input:
                block=block_read_by(stage),
                code=sources(*stage.code),
            output:
                output_of(stage),
            log:
                log_of(stage.name, file_of(stage)),
            benchmark:
                benchmark_of(stage.name, file_of(stage))
            threads: threads_for(job_of_stage(stage.name))
            resources:
                **needs(job_of_stage(stage.name)),
            params:
                command=stage.command,
                settings=settings_of(stage),
            message:
                message_of(stage)
            shell:
                "grainmodes {params.command} {input.block} --kt {wildcards.kt}"
                " --processes {threads} --settings {params.settings:q} -o {output}"
                " 2>&1 | tee {log} >&2"

    else:

        rule:
            name:
                stage.name
            input:
                block=block_read_by(stage),
                code=sources(*stage.code),
            output:
                output_of(stage),
            log:
                log_of(stage.name, file_of(stage)),
            benchmark:
                benchmark_of(stage.name, file_of(stage))
            resources:
                **needs(job_of_stage(stage.name)),
            params:
                command=stage.command,
                settings=settings_of(stage),
            message:
                message_of(stage)
            shell:
                "grainmodes {params.command} {input.block} --kt {wildcards.kt}"
                " --settings {params.settings:q} -o {output}"
                " 2>&1 | tee {log} >&2"

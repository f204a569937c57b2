# Packings -> fields of the sample of seed 0: displacements and single eigenvectors, by grain.


rule fields:
    input:
        packings=first_packings,
        code=sources("grainmodes.field_blocks:fields_block"),
    output:
        f"{STUDY}/fields/{POINT}",
    params:
        settings=scene.settings("fields"),
    message:
        "Fields at n = {wildcards.n}, phi = {wildcards.phi}, k_T = {wildcards.kt}."
    shell:
        "grainmodes fields {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"

# Packings -> rigidity in theory, rigidity in simulation, spectrum, each for one k_T.


rule rigidity:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.blocks:rigidity_block"),
    output:
        f"{STUDY}/rigidity/{RESPONSE}",
    params:
        settings=scene.settings("rigidity"),
    message:
        f"Rigidity at {AT}."
    shell:
        "grainmodes rigidity {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule step_strain:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.blocks:step_strain_block"),
    output:
        f"{STUDY}/step_strain/{RESPONSE}",
    params:
        settings=scene.settings("step_strain"),
    message:
        f"Step strain at {AT}."
    shell:
        "grainmodes step-strain {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule spectrum:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.blocks:spectrum_block"),
    output:
        f"{STUDY}/spectrum/{RESPONSE}",
    params:
        settings=scene.settings("spectrum"),
    message:
        f"Spectrum at {AT}."
    shell:
        "grainmodes spectrum {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"

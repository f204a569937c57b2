# Packings -> rigidity in theory and simulation, spectra, shear, fields, each for one k_T.


rule rigidity:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.packings:rigidity_block"),
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
        code=sources("grainmodes.stages.packings:step_strain_block"),
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
        code=sources("grainmodes.stages.spectrum:spectrum_block"),
    output:
        f"{STUDY}/spectrum/{RESPONSE}",
    params:
        settings=spectrum_settings("spectrum"),
    message:
        f"Spectrum at {AT}."
    shell:
        "grainmodes spectrum {input.packings} --kt {wildcards.kt} --processes {threads}"
        " --settings {params.settings:q} -o {output}"


rule spectrum_rattlers:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.spectrum:rattlers_block"),
    output:
        f"{STUDY}/spectrum_rattlers/{RESPONSE}",
    params:
        settings=spectrum_settings("spectrum_rattlers"),
    message:
        f"Spectrum with rattlers at {AT}."
    shell:
        "grainmodes spectrum {input.packings} --variant rattlers --kt {wildcards.kt}"
        " --processes {threads}"
        " --settings {params.settings:q} -o {output}"


rule spectrum_hessian:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.spectrum:hessian_block"),
    output:
        f"{STUDY}/spectrum_hessian/{RESPONSE}",
    params:
        settings=scene.settings("spectrum_hessian"),
    message:
        f"Spectrum of the effective Hessian at {AT}."
    shell:
        "grainmodes spectrum {input.packings} --variant hessian --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule claim_diagnostics:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.claim_diagnostics:claim_diagnostics_block"),
    output:
        f"{STUDY}/claim_diagnostics/{RESPONSE}",
    params:
        settings=scene.settings("claim_diagnostics"),
    message:
        f"Probe what single claims need at {AT}."
    shell:
        "grainmodes claim-diagnostics {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule shear:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.shear:shear_block", "grainmodes.stages.checkpoints"),
    output:
        f"{STUDY}/shear/{RESPONSE}",
    params:
        settings=shear_settings,
    message:
        f"Shear at {AT}."
    shell:
        "grainmodes shear {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule complex_pairs:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.complex_pairs:complex_pairs_block"),
    output:
        f"{STUDY}/complex_pairs/{RESPONSE}",
    params:
        settings=scene.settings("complex_pairs"),
    message:
        f"Complex pairs at {AT}."
    shell:
        "grainmodes complex-pairs {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule release:
    input:
        pairs=f"{STUDY}/complex_pairs/{RESPONSE}",
        code=sources("grainmodes.stages.release:release_block", "grainmodes.stages.checkpoints"),
    output:
        f"{STUDY}/release/{RESPONSE}",
    params:
        settings=scene.settings("release"),
    message:
        f"Release at {AT}."
    shell:
        "grainmodes release {input.pairs} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule law_comparison:
    input:
        packings=f"{STUDY}/packings/{BLOCK}",
        code=sources("grainmodes.stages.law_comparison:law_comparison_block"),
    output:
        f"{STUDY}/law_comparison/{RESPONSE}",
    params:
        settings=scene.settings("law_comparison"),
    message:
        f"Tangential laws side by side at {AT}."
    shell:
        "grainmodes law-comparison {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule fields:
    input:
        packings=first_packings,
        code=sources("grainmodes.stages.fields:fields_block"),
    output:
        f"{STUDY}/fields/{POINT}",
    params:
        settings=scene.settings("fields"),
    message:
        "Fields at n = {wildcards.n}, phi = {wildcards.phi}, k_T = {wildcards.kt}."
    shell:
        "grainmodes fields {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"


rule event_detail:
    input:
        packings=first_packings,
        code=sources("grainmodes.stages.event_detail:event_detail_block"),
    output:
        f"{STUDY}/event_detail/{POINT}",
    params:
        settings=scene.settings("event_detail"),
    message:
        "First event at n = {wildcards.n}, phi = {wildcards.phi}, k_T = {wildcards.kt}."
    shell:
        "grainmodes event-detail {input.packings} --kt {wildcards.kt}"
        " --settings {params.settings:q} -o {output}"

# Consistency checks of the ensemble; if one of them fails, the study has no checks.txt.


rule checks:
    input:
        ensemble=rules.ensemble.output,
        checks="workflow/checks/test_ensemble.py",
        report="workflow/checks/conftest.py",
    output:
        f"{STUDY}/checks.txt",
    message:
        "Check the consistency of the ensemble."
    shell:
        "python -m pytest -p no:cacheprovider {input.checks}"
        " --ensemble {input.ensemble} --report {output}"

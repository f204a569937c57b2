# Questions to the ensemble; a study whose ensemble fails one of them has no checks.txt.


rule checks:
    input:
        ensemble=rules.ensemble.output,
        questions="workflow/checks/test_ensemble.py",
        report="workflow/checks/conftest.py",
    output:
        f"{STUDY}/checks.txt",
    message:
        "Question the ensemble."
    shell:
        "python -m pytest -p no:cacheprovider {input.questions}"
        " --ensemble {input.ensemble} --report {output}"

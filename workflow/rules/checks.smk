# Questions to the ensemble; a study whose ensemble fails one of them has no checks.txt.


rule checks:
    input:
        ensemble=rules.ensemble.output,
        questions="workflow/checks/test_ensemble.py",
    output:
        f"{STUDY}/checks.txt",
    message:
        "Question the ensemble."
    shell:
        "python -m pytest {input.questions} --ensemble {input.ensemble} | tee {output}"

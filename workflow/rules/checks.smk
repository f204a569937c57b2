# Consistency checks of the ensemble. A check that fails leaves its line in checks.txt, and the study
# ends with an error once everything else is there. Status 1 of pytest means that a check has failed.


rule checks:
    input:
        ensemble=rules.ensemble.output,
        checks=source("workflow/checks/test_ensemble.py"),
        report=source("workflow/checks/conftest.py"),
    output:
        f"{STUDY}/checks.txt",
    log:
        log_of("checks"),
    benchmark:
        benchmark_of("checks")
    resources:
        **needs(job_of_reader),
    message:
        "Check the consistency of the ensemble."
    shell:
        "(python -m pytest -p no:cacheprovider {input.checks:q}"
        " --ensemble {input.ensemble} --report {output} || [ $? -eq 1 ])"
        " 2>&1 | tee {log} >&2"


rule passed:
    input:
        checks=rules.checks.output,
        everything=ancient([f"{STUDY}/claims.md", *figures()]),
    output:
        touch(f"{STUDY}/checks.passed"),
    log:
        log_of("passed"),
    benchmark:
        benchmark_of("passed")
    resources:
        **needs(job_of_reader),
    message:
        "See whether all checks have passed."
    shell:
        "(if grep '^failed' {input.checks}; then"
        " echo 'Checks have failed: see {input.checks}.' >&2; exit 1; fi)"
        " 2>&1 | tee {log} >&2"

# Speeds on this machine; no output is declared, so that asking for it always measures.


rule benchmarks:
    input:
        scripts="tests/benchmarks/run.py",
    message:
        "Measure the speeds."
    shell:
        "python {input.scripts} | tee results/benchmarks.txt"


rule growth:
    input:
        scripts="tests/benchmarks/growth.py",
    message:
        "Measure how costs grow with N, into results/costs.yaml."
    shell:
        "python {input.scripts} results/costs.yaml"

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


rule effects:
    input:
        scripts="tests/benchmarks/effects.py",
    message:
        "Measure what each effect costs at each stage, into results/effects.csv."
    shell:
        "python {input.scripts} results/effects.csv"

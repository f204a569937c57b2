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
    params:
        longest=30,  # CPU seconds of a single run
    message:
        "Measure how time and memory grow with N, into results/growth.csv, .png, .pdf, costs.yaml."
    shell:
        "python {input.scripts} results --longest {params.longest}"


rule effects:
    input:
        scripts="tests/benchmarks/effects.py",
    message:
        "Measure what each effect costs at each stage, into results/effects.csv."
    shell:
        "python {input.scripts} results/effects.csv"

# Speeds on this machine; no output is declared, so that asking for it always measures.


rule benchmarks:
    input:
        scripts="measurements/benchmarks/run.py",
    message:
        "Measure the speeds."
    shell:
        "python -m measurements.benchmarks.run | tee results/benchmarks.txt"


rule growth:
    input:
        scripts="measurements/benchmarks/growth.py",
    params:
        longest=30,  # CPU seconds of a single run
    message:
        "Measure how time and memory grow with N, into results/growth.csv, .png, .pdf, costs.yaml."
    shell:
        "python -m measurements.benchmarks.growth results --longest {params.longest}"


rule effects:
    input:
        scripts="measurements/benchmarks/effects.py",
    message:
        "Measure what each effect costs at each stage, into results/effects.csv."
    shell:
        "python -m measurements.benchmarks.effects results/effects.csv"

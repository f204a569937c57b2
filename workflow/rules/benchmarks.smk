# Speeds on this machine; no output is declared, so that asking for it always measures.


rule benchmarks:
    input:
        scripts=source("measurements/benchmarks/run.py"),
    log:
        "logs/benchmarks.log",
    benchmark:
        "logs/benchmarks.tsv"
    resources:
        **needs(job_of_measurement(65536, 3600)),
    message:
        "Measure the speeds."
    shell:
        "mkdir -p results; python -m measurements.benchmarks.run | tee results/benchmarks.txt 2>&1 | tee {log} >&2"


rule growth:
    input:
        scripts=source("measurements/benchmarks/growth.py"),
    log:
        "logs/growth.log",
    benchmark:
        "logs/growth.tsv"
    resources:
        **needs(job_of_measurement(65536, 7200)),
    params:
        longest=30,  # CPU seconds of a single run
    message:
        "Measure how time and memory grow with N, into results/growth.csv, .png, .pdf, costs.yaml."
    shell:
        "python -m measurements.benchmarks.growth results --longest {params.longest}"
        " 2>&1 | tee {log} >&2"


rule effects:
    input:
        scripts=source("measurements/benchmarks/effects.py"),
    log:
        "logs/effects.log",
    benchmark:
        "logs/effects.tsv"
    resources:
        **needs(job_of_measurement(4096, 3600)),
    message:
        "Measure what each effect costs at each stage, into results/effects.csv."
    shell:
        "python -m measurements.benchmarks.effects results/effects.csv 2>&1 | tee {log} >&2"

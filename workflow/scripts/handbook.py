"""Write the parts of the documentation that follow from tables: `make handbook`.

| part                                        | follows from                       |
| ------------------------------------------- | ---------------------------------- |
| docs/data.md: variables                     | `grainmodes.dataset.VARIABLES`     |
| docs/data.md: values of the attribute stage | `grainmodes.parameters.stages`     |
| config/README.md: `grids.observables.…`     | `grainmodes.parameters.stages`     |

With `--check` nothing is written; the exit status is 1 where a page is out of date.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from grainmodes.dataset import VARIABLES
from grainmodes.parameters.stages import STAGES, observable_keys, responses

ROOT = Path(__file__).parents[2]


def data_page(text: str) -> str:
    """docs/data.md with the rows of all variables and stages."""
    rows = []
    for name, variable in VARIABLES.items():
        meaning = variable.long_name.replace("|", r"\|")
        dimensions = ", ".join(variable.dimensions)
        rows.append(f"| `{name}` | {dimensions} | {variable.unit.text()} | {meaning} |\n")
    head = "| name | dimensions | units | meaning |\n| --- | --- | --- | --- |\n"
    text = re.sub(re.escape(head) + r"(\|.*\n)+", lambda _: head + "".join(rows), text)
    outputs = ", ".join(dict.fromkeys(stage.output for stage in STAGES.values()))
    row = f"| `stage` | blocks, points | {outputs} or point |"
    return re.sub(r"^\| `stage` \| blocks, points \|.*$", lambda _: row, text, flags=re.MULTILINE)


def config_page(text: str) -> str:
    """config/README.md with the keys of all observables."""
    rows = []
    for stage in responses():
        notes = " Only at k_T > 0." if stage.needs_friction else ""
        notes += " Not where `preparation` is frictional." if stage.needs_springs_at_rest else ""
        if STAGES[stage.reads].observable:
            notes += f" Computes `{STAGES[stage.reads].observable}` first."
        for key, rule in observable_keys([stage]).items():
            value, meaning = str(rule["default"]).lower(), f"{rule['description']}{notes}"
            rows.append(f"| `grids.observables.{key}` | {value} | {meaning} |\n")
    return re.sub(r"(\| `grids\.observables\..*\n)+", lambda _: "".join(rows), text)


PAGES = {"docs/data.md": data_page, "config/README.md": config_page}


def main(options: list[str]) -> int:
    """Write the pages, or say which are out of date."""
    stale = []
    for name, page in PAGES.items():
        path = ROOT / name
        text = path.read_text(encoding="utf-8")
        if page(text) != text:
            stale.append(name)
            if "--check" not in options:
                path.write_text(page(text), encoding="utf-8")
    if stale and "--check" in options:
        print(f"out of date: {', '.join(stale)}; run `make handbook`", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""The table of verdicts as text, page and CSV, and the command that writes it."""

import csv
import json

import numpy as np

import claim_fixtures
from edited_files import edited
from grainmodes.claims import check, report
from grainmodes.cli import main

COUNTS = {"A": 22, "B": 14, "C": 16, "G": 4}
NAMES = [f"{paper}{number + 1}" for paper, count in COUNTS.items() for number in range(count)]


def test_reports_hold_every_claim(tmp_path):
    found = check(claim_fixtures.ensemble().drop_vars("g_simulated"))
    for suffix in report.FORMS:
        report.write(found, tmp_path / f"claims{suffix}")
    with open(tmp_path / "claims.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    page = (tmp_path / "claims.md").read_text(encoding="utf-8")
    assert [row["claim"] for row in rows] == [verdict.claim for verdict in found]
    assert [row["claim"] for row in rows][: len(NAMES)] == NAMES
    assert float(rows[1]["measured"]) == found[1].measured
    assert all(f"| {name} |" in page and f"**{name}, " in page for name in NAMES)
    table = [line.replace("\\|", "") for line in page.splitlines() if line.startswith("|")]
    assert {line.count("|") for line in table} == {8}
    assert "24 holds" in report.as_text(found)
    assert f"{len(found) - 24} not tested" in report.as_text(found)


def test_the_page_names_lost_samples(tmp_path, capsys):
    path = tmp_path / "ensemble.nc"
    lost = {"spectrum": {"16,0.9,1.0,2": "no balance"}}
    whole = claim_fixtures.ensemble().assign_coords(mode=np.arange(3 * claim_fixtures.GRAINS[-1]))
    whole.assign_attrs(failures=json.dumps(lost)).to_netcdf(path)
    with edited(path):
        pass
    assert main(["claims", str(path), "-o", str(tmp_path / "claims.md")]) == 0
    sentence = "Lost samples: 1 failed in spectrum (n = 16, phi = 0.9, kt = 1, seed 2: no balance)."
    assert sentence in (tmp_path / "claims.md").read_text(encoding="utf-8").split("\n\n|")[0]
    assert main(["claims", str(path)]) == 0
    assert sentence in capsys.readouterr().out


def test_the_command_prints_writes_and_refuses(tmp_path, capsys):
    path = tmp_path / "ensemble.nc"
    modes = {"mode": np.arange(3 * claim_fixtures.GRAINS[-1])}
    claim_fixtures.ensemble().assign_coords(modes).to_netcdf(path)
    with edited(path):
        pass
    assert main(["claims", str(path)]) == 0
    assert capsys.readouterr().out.startswith("A1   holds")
    assert main(["claims", str(path), "-o", str(tmp_path / "a.md"), str(tmp_path / "a.csv")]) == 0
    assert (tmp_path / "a.md").is_file() and (tmp_path / "a.csv").is_file()
    assert main(["claims", str(path), "-o", str(tmp_path / "a.txt")]) == 1
    assert "expected a suffix among .md, .csv" in capsys.readouterr().err
    assert main(["claims", str(tmp_path / "none.nc")]) == 1
    assert "no such file" in capsys.readouterr().err

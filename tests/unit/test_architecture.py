"""ARCHITECTURE.md says what the contracts of import-linter hold the code to."""

import configparser
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "grainmodes"
LIBRARIES = {"matplotlib", "numba", "pandas", "xarray"}


def contracts() -> dict[str, dict[str, list[str]]]:
    """Contract → its lists of names, without the name of the package."""
    parser = configparser.ConfigParser()
    parser.read(ROOT / ".importlinter")
    lists = {}
    for section in parser.sections():
        values = {key: value.split("\n")[1:] for key, value in parser[section].items()}
        stripped = {
            key: [line.strip().removeprefix("grainmodes.") for line in lines]
            for key, lines in values.items()
        }
        lists[section.removeprefix("importlinter:contract:")] = stripped
    return lists


def rows() -> list[tuple[list[str], str]]:
    """The rooms of each row of the table, and its last column."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    table = text.split("alone may import |")[1].split("\n\n")[0]
    cells = [line.strip("|").split("|") for line in table.splitlines()[2:]]
    return [(re.findall(r"`(\w+)`", first), last) for first, _, last in cells]


def test_the_rows_are_the_layers():
    layers = [re.split(r"\s*\|\s*", line) for line in contracts()["layers"]["layers"]]
    assert [set(rooms) for rooms, _ in rows()] == [set(layer) for layer in layers]


def test_every_room_has_a_row_and_only_one():
    named = [room for rooms, _ in rows() for room in rooms]
    assert sorted(named) == sorted(
        path.name for path in PACKAGE.iterdir() if (path / "__init__.py").is_file()
    )
    modules = {path.name for path in PACKAGE.glob("*.py")}
    assert modules == {"__init__.py", "__main__.py"}, "a module outside of all rooms"


def test_the_last_column_is_what_the_forbidden_contracts_leave():
    forbidden: dict[str, set[str]] = {}
    for contract in contracts().values():
        for library in LIBRARIES & set(contract.get("forbidden_modules", [])):
            forbidden[library] = forbidden.get(library, set()) | set(contract["source_modules"])
    assert set(forbidden) == LIBRARIES
    for rooms, cell in rows():
        stated: dict[str, set[str]] = {}
        for words, where in re.findall(r"((?:\w+(?: and |, )?)+)\s*(\([^)]*\))?", cell):
            for library in re.findall(r"\w+", words):
                if library in LIBRARIES:
                    stated[library] = set(re.findall(r"`(\w+)`", where)) or set(rooms)
        allowed = {library: set(rooms) - sources for library, sources in forbidden.items()}
        assert stated == {library: own for library, own in allowed.items() if own}


def test_a_page_is_a_page():
    assert len((ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8").splitlines()) <= 100


def test_the_unit_tests_mirror_the_rooms():
    tests = ROOT / "tests" / "unit"
    folders = {path.relative_to(tests) for path in tests.rglob("*") if list(path.glob("test_*.py"))}
    rooms = {path.relative_to(PACKAGE) for path in PACKAGE.rglob("*") if path.is_dir()}
    assert folders - rooms <= {Path("measurements")}

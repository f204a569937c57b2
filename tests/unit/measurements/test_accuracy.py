"""Work-precision diagrams: the knee, their file, their picture, and a tiny one of each choice."""

import math
import subprocess
import sys
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from measurements.accuracy import (
    NAMES,
    backtracking,
    draw,
    force_tolerance,
    growth_rate,
    panels,
    strain_step,
    table,
    time_step,
)
from measurements.accuracy.diagram import (
    FAILED,
    DiagramRow,
    ProcessResult,
    Size,
    TimedError,
    in_fresh_process,
    knee,
    summarise,
    timed,
)

ROOT = Path(__file__).parents[3]
SCRIPTS = ROOT / "measurements" / "accuracy"
RUN = (sys.executable, "-m")


def curve(errors, seconds=None, failed=None, name="fast, error of g") -> list[DiagramRow]:
    """A curve of these errors, each point by default ten times as dear as the one before."""
    seconds = seconds or [10.0**k for k in range(len(errors))]
    failed = failed or [0] * len(errors)
    return [
        DiagramRow(name, 10.0**-k, time, 200.0, error, 0.1 * error, 8 - lost, lost, k == 1)
        for k, (error, time, lost) in enumerate(zip(errors, seconds, failed, strict=True))
    ]


def test_the_knee_is_the_cheapest_within_three_times_the_least_error():
    rows = curve([1e-2, 1e-4, 2.9e-8, 1e-8, 2e-8])
    assert knee(rows) == rows[2]
    assert knee(curve([1e-2, 1e-4, 3.1e-8, 1e-8, 2e-8])).error == 1e-8
    assert knee(curve([1e-2, 2e-8, 1e-8], seconds=[3.0, 2.0, 1.0])).error == 1e-8
    assert knee(curve([1e-2, 0.0, 0.0])).setting == 0.1


def test_a_setting_that_failed_a_sample_is_no_knee():
    assert knee(curve([1e-2, 1e-8, 1e-8], failed=[0, 1, 0])).setting == 1e-2
    assert knee(curve([1e-2, math.nan, math.inf], failed=[0, 8, 0])).setting == 1.0
    assert knee(curve([math.nan], failed=[8])) is None


def test_a_row_is_the_median_over_the_samples_that_came_to_a_result():
    samples = [TimedError(float(k), 10.0 * k) for k in range(1, 6)]
    assert summarise("c", 0.5, [*samples, FAILED], 150.0, True) == DiagramRow(
        "c", 0.5, 3.0, 150.0, 30.0, 10.0, 5, 1, True
    )
    none = summarise("c", 0.5, [FAILED], 150.0)
    assert math.isnan(none.error)
    assert (none.samples, none.failed) == (0, 1)


def grown(megabytes: int) -> int:
    """Touch so much memory."""
    return len(bytearray(megabytes * 2**20))


def test_memory_is_that_of_a_process_of_its_own():
    held = bytearray(500 * 2**20)
    much, little = in_fresh_process(grown, 400), in_fresh_process(grown, 1)
    assert len(held) > little.megabytes * 2**20
    assert much.value == 400 * 2**20
    assert 300.0 < much.megabytes - little.megabytes < 500.0
    assert 0.0 < much.seconds < 5.0


def test_a_short_call_is_timed_until_the_clock_sees_it():
    calls = []
    value, seconds = timed(lambda: calls.append(0) or len(calls), at_least=0.02)
    assert value == len(calls) > 100
    assert 0.02 / len(calls) <= seconds < 0.02


def measured(rows: list[DiagramRow]) -> table.Table:
    """A table of these rows, as measured here."""
    return table.table_of(strain_step.DIAGRAM, strain_step.DIAGRAM.small, rows)


def test_a_table_comes_back_to_the_last_digit(tmp_path):
    rows = curve([1e-2, 1 / 3, math.nan, 0.0], failed=[0, 0, 8, 0])
    rows += curve([0.1, 0.2], name="slow")
    path = tmp_path / "new" / "table.csv"
    table.write(path, measured(rows))
    back = table.read(path)
    assert str(list(table.curves(back).values())) == str([rows[:4], rows[4:]])
    assert back.words["title"] == strain_step.DIAGRAM.title
    assert back.words["grains"] == "64"
    assert f"Python {sys.version.split()[0]}" in back.words["machine"]
    assert back.words["code"].startswith("0.1.0+")


def test_a_file_that_is_no_table_is_refused(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("a,b\n1,2\n")
    with pytest.raises(
        ValueError, match=r"table.csv: expected a file of measure.py, got no title, grains, "
    ):
        table.read(path)
    head = "".join(f"# {name}: x\n" for name in table.WORDS)
    path.write_text(f"{head}a,b\n1,2\n")
    with pytest.raises(ValueError, match=r"expected the columns curve, setting, .* got "):
        table.read(path)


def test_a_picture_shows_every_curve_its_knee_and_the_default(tmp_path):
    rows = curve([1e-2, 1e-5, 1e-8, 0.0, math.nan], failed=[0, 1, 0, 0, 8])
    rows += curve([1e-1, 1e-3], name="slow, error of g")
    table.write(tmp_path / "t.csv", measured(rows))
    subprocess.run(
        [*RUN, "measurements.accuracy.draw", tmp_path / "t.csv", "-o", tmp_path / "t"],
        check=True,
        cwd=ROOT,
    )
    assert {path.name for path in tmp_path.iterdir()} == {"t.csv", "t.png", "t.pdf"}
    assert (tmp_path / "t.png").stat().st_size > 20_000


def picture(names: list[str]) -> Figure:
    figure = Figure()
    lines = [row for name in names for row in curve([1e-2, 1e-5, 1e-8], name=name)]
    draw.draw(figure, measured(lines))
    return figure


def test_many_curves_have_panels_by_quantity_and_a_legend_of_methods():
    methods = ["b = 0.1", "b = 0.01", "b = 0.001"]
    names = [f"{method}, {what}" for method in methods for what in "gPZ"]
    figure = picture(names)
    shown = [axes for axes in figure.axes if axes.get_visible()]
    assert len(shown) == 2 * 3 + 1
    titles = [axes.get_title("left") for axes in shown]
    assert [title for title in titles if title] == ["(a) g", "(b) P", "(c) Z", "(d) memory"]
    (legend,) = figure.legends
    words = [text.get_text() for text in legend.get_texts()]
    assert words == ["knee", "default", *methods]
    styles = panels.assign_styles(names)
    assert styles["b = 0.1, g"] == styles["b = 0.1, P"] != styles["b = 0.01, g"]


def test_a_few_curves_share_three_panels_and_are_all_in_the_legend():
    names = ["fast, g", "fast, contacts", "FIRE, g"]
    figure = picture(names)
    assert len(figure.axes) == 3
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["knee", "default", *names]


def test_curves_of_one_kind_share_a_symbol_and_of_one_quantity_a_colour():
    styles = panels.assign_styles(["fast, g", "fast, contacts", "FIRE, g", "all"])
    assert styles["fast, g"].marker == styles["fast, contacts"].marker != styles["FIRE, g"].marker
    assert styles["fast, g"].color == styles["FIRE, g"].color != styles["fast, contacts"].color
    assert len({style.color for style in styles.values()}) == 3


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["measure", "colour", "-o", "c.csv"], "invalid choice: 'colour'"),
        (["measure", "strain_step"], "required: -o"),
        (["draw", "none.csv", "-o", "c"], "draw.py: [Errno 2]"),
    ],
)
def test_bad_input_gets_one_sentence(tmp_path, words, sentence):
    command = [*RUN, f"measurements.accuracy.{words[0]}", *words[1:]]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert run.returncode != 0
    assert sentence in run.stderr
    assert "Traceback" not in run.stderr
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def in_this_process():
    """No measurement starts a fresh process, each of which would load the kernels again."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (backtracking, force_tolerance, strain_step, time_step):
            patch.setattr(
                module,
                "in_fresh_process",
                lambda find, *given: ProcessResult(find(*given), 0.0, 1.0),
            )
        yield


def test_every_diagram_has_a_module_and_says_what_it_needs():
    texts = {path.stem: path.read_text(encoding="utf-8") for path in SCRIPTS.glob("*.py")}
    assert {name for name, text in texts.items() if "\nDIAGRAM = " in text} == set(NAMES)


@pytest.mark.parametrize(
    ("relaxation", "forward"),
    [
        ("Newton", "Newton, forward"),
        pytest.param("damped", "damped to 1e-14, forward", marks=pytest.mark.slow),
    ],
)
def test_step_strains(monkeypatch, in_this_process, relaxation, forward):
    methods = {
        name: method for name, method in strain_step.METHODS.items() if name.startswith(relaxation)
    }
    monkeypatch.setattr(strain_step, "METHODS", methods)
    monkeypatch.setattr(strain_step, "STRAINS", (1e-3, 1e-6))
    rows = list(strain_step.measure(Size((16,), 1)))
    error = {(row.curve, row.setting): row.error for row in rows}
    assert error[forward, 1e-6] < 2e-3 * error[forward, 1e-3]
    if relaxation == "Newton":
        assert error["Newton, both sides", 1e-6] < 1e-8
        assert [row.setting for row in rows if row.default] == [1e-6]
    assert {row.failed for row in rows} == {0}


def test_force_tolerances(monkeypatch, in_this_process):
    monkeypatch.setattr(force_tolerance, "TOLERANCES", (1e-5, 1e-14))
    rows = list(force_tolerance.measure(Size((16,), 2)))
    error = {(row.curve, row.setting): row.error for row in rows}
    for name in force_tolerance.RELAXATIONS:
        for what in ("of g", "of the ten lowest eigenvalues"):
            assert error[f"{name}, {what}", 1e-14] < 1e-8 < error[f"{name}, {what}", 1e-5]
        assert error[f"{name}, of the contacts", 1e-14] == 0.0
    assert {(row.curve.partition(",")[0], row.setting) for row in rows if row.default} == {
        ("FIRE + Newton", 1e-14)
    }


def test_contacts_are_compared_in_the_numbers_of_all_grains():
    packing = force_tolerance.compressed(16, 1, 0.85)
    exact = force_tolerance.reference(force_tolerance.relax_fire_newton, packing)
    one = exact._replace(contacts=exact.contacts - {min(exact.contacts)} | {(99, 98)})
    assert one.errors(exact) == (0.0, 0.0, 2 / len(exact.contacts))


def slope(rows: list[DiagramRow], curve: str) -> float:
    """Decades of error per decade of the setting, between the two shortest."""
    coarse, fine = [row for row in rows if row.curve == curve][1:]
    return math.log(coarse.error / fine.error) / math.log(coarse.setting / fine.setting)


@pytest.fixture(scope="module")
def stepped(in_this_process):
    """Two time steps on few grains, and one that is too long."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(time_step, "TIME_STEPS", (4.0, 4e-3, 1e-3))
        patch.setattr(time_step, "UNSTABLE_N", 10)
        return list(time_step.measure(Size((16,), 1)))


@pytest.mark.parametrize(
    ("damping", "orders"), [("no damping", (2, 2, 3, 3)), ("dashpots", (1, 1, 3, 2))]
)
def test_orders_of_velocity_verlet(stepped, damping, orders):
    spans, quantities = time_step.SPANS, time_step.QUANTITIES
    found = [slope(stepped, f"{damping}, {q} after {s}") for s in spans for q in quantities]
    assert found == pytest.approx(orders, abs=0.15)


def test_the_growth_rate_of_a_release_has_order_two():
    state = growth_rate.unstable_state(16, 4)
    errors = [state.rate(step) / state.omega.imag - 1.0 for step in (0.2, 0.05)]
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.02)
    assert growth_rate.unstable_state(10, 1) is None


def test_a_time_step_beyond_the_limit_has_failed(stepped):
    beyond = [row for row in stepped if row.setting == 4.0]
    assert {(row.samples, row.failed) for row in beyond} == {(0, 1)}


def test_brackets(monkeypatch, in_this_process):
    monkeypatch.setattr(backtracking, "WIDTHS", (1e-4, 1e-7))
    monkeypatch.setattr(backtracking, "COARSE_WIDTHS", (1e-5,))
    rows = list(backtracking.measure(Size((32,), 1)))
    error = {(row.curve, row.setting): row.error for row in rows}
    for name in ("friction", "no friction"):
        assert error[f"{name}, steps taken back", 1e-7] <= 0.5e-7
        assert error[f"{name}, steps taken back", 1e-4] <= 1e-4
    assert error["no friction, every step as short", 1e-5] <= 1e-5


def test_a_shear_without_an_event_has_no_critical_strain():
    packing, interaction = backtracking.harmonic(32, 0), backtracking.FRICTION
    assert math.isnan(backtracking.critical_strain(packing, interaction, backtracking.Shear(2e-4)))

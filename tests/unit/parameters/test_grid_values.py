"""Numbers ↔ text in paths, blocks of seeds, checkpoints."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grainmodes.parameters import fields, grid


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_text_of_a_number_reads_back(value):
    assert float(grid.format_value(value)) == value


@given(st.integers())
def test_text_of_a_whole_number_reads_back(value):
    assert int(grid.format_value(value)) == value


def test_equal_numbers_have_one_text():
    assert grid.format_value(0.840) == grid.format_value(0.84) == "0.84"


@given(st.integers(0, grid.MAX_SEED - 10_000), st.integers(0, 9_999))
def test_text_of_a_block_reads_back(first, length):
    text = grid.format_seeds(first, first + length)
    assert grid.parse_seeds(text) == range(first, first + length + 1)


@pytest.mark.parametrize("text", ["", "3", "a-b", "5-3", "-1-3", "0-1-2", "²-3", "1_0-1_1", "0- 1"])
def test_block_names_are_checked(text):
    with pytest.raises(ValueError, match="expected first-last"):
        grid.parse_seeds(text)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (f"0-{2**63}", f"expected seeds of at most {2**63 - 1}, got {2**63}"),
        (f"{2**64}-{2**64}", f"expected seeds of at most {2**63 - 1}, got {2**64}"),
        ("0-99999999999", "expected at most 10000 seeds, got 100000000000"),
        ("0-" + "9" * 5000, "expected first-last"),
    ],
)
def test_seeds_have_their_limits(text, sentence):
    with pytest.raises(ValueError, match=sentence):
        grid.parse_seeds(text)


@given(st.integers(1, 500), st.integers(1, 50))
def test_blocks_hold_every_seed_once(count, size):
    blocks = [grid.parse_seeds(text) for text in grid.seed_blocks(count, size)]
    assert [seed for block in blocks for seed in block] == list(range(count))
    assert all(len(block) == size for block in blocks[:-1])


@given(st.integers(1, 50), st.integers(1, 50), st.integers(1, 20))
def test_growing_by_whole_blocks_keeps_the_old_ones(blocks, more, size):
    old = grid.seed_blocks(blocks * size, size)
    assert grid.seed_blocks((blocks + more) * size, size)[:blocks] == old


@given(st.floats(grid.LOWEST_CHECKPOINT, 1.2))
def test_a_checkpoint_lies_at_or_just_below(phi):
    checkpoint = grid.checkpoint_at_or_below(phi)
    assert checkpoint <= phi < checkpoint + grid.CHECKPOINT_SPACING + 1e-15


@given(st.integers(1, 40), st.floats(1e-15, 5e-9))
def test_just_below_a_checkpoint_the_one_before_it_counts(step, less):
    above, below = (round(grid.LOWEST_CHECKPOINT + 0.01 * k, 12) for k in (step, step - 1))
    assert grid.checkpoint_at_or_below(above - less) == below
    assert grid.checkpoints_up_to(above - less)[-1] == below


@given(st.integers(0, 40))
def test_a_checkpoint_is_its_own(step):
    phi = round(grid.LOWEST_CHECKPOINT + step * grid.CHECKPOINT_SPACING, 12)
    assert grid.checkpoint_at_or_below(phi) == phi


@given(st.integers(0, 6000))
def test_steps_of_the_compression_do_not_drift(step):
    assert grid.phi_at_step(0.6, 1e-4, step) == pytest.approx(0.6 + step / 1e4, abs=1e-12)
    assert len(grid.format_value(grid.phi_at_step(0.6, 1e-4, step))) <= 6


@pytest.mark.parametrize(
    ("kt", "frequencies"),
    [
        (1e-8, (1e-4, 1.3e-2, 1.0)),
        (1e-4, (1e-2, 1.3e-2, 1.0)),
        (1.0, (1.3e-2, 1.0)),
        (0.0, (1.3e-2, 1.0)),
    ],
)
def test_single_modes_are_those_of_the_paper(kt, frequencies):
    assert fields.field_frequencies(kt) == frequencies

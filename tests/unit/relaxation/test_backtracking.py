"""The fractions of a step that a line search tries."""

from grainmodes.relaxation.backtracking import MIN_STEP_FRACTION, backtrack


def test_a_step_is_halved_until_it_improves():
    tried = []
    found = backtrack(lambda fraction: tried.append(fraction) or fraction, lambda x: x < 0.4)
    assert found == 0.25
    assert tried == [1.0, 0.5, 0.25]


def test_a_step_that_never_improves_gives_nothing():
    tried = []
    assert backtrack(lambda fraction: tried.append(fraction), lambda state: False) is None
    assert tried == [1.0, 0.5, 0.25, 0.125]
    assert tried[-1] >= MIN_STEP_FRACTION > 0.5 * tried[-1]

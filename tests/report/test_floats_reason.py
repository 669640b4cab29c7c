"""The reason for floats, where `solve` chose them, in what it prints."""

from __future__ import annotations

from studies.train_families import grid

from geartrain import GearTrain


def test_an_answer_says_why_floats_were_chosen_and_how_to_get_fractions() -> None:
    train = GearTrain.declare(grid(3000))
    answer = train.solve()
    estimate = max(answer.accuracy[link].estimate for link in answer.speeds)
    assert 0 < estimate < 1e-10
    assert "Solved in floats: the system is coupled too densely" in str(answer)
    assert f"The estimated error of every speed is at most {estimate:.1e}." in str(answer)
    assert "`geartrain solve FILE --method exact`" in str(answer)
    assert "Solved in floats" not in str(GearTrain.declare(grid(100)).solve(method="floats"))

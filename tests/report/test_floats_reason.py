"""The reason for floats, where `solve` chose them, in what `solve` and `report` print."""

from __future__ import annotations

from studies.train_families import grid

from geartrain import GearTrain
from geartrain.report import collect_report, describe_train, to_text


def test_solve_and_report_say_why_floats_were_chosen_and_how_to_get_fractions() -> None:
    train = GearTrain.declare(grid(3000))
    answer = train.solve()
    estimate = max(answer.accuracy[link].estimate for link in answer.speeds)
    assert 0 < estimate < 1e-10
    for text in (str(answer), " ".join(to_text([describe_train(collect_report(train))]).split())):
        assert "Solved in floats: the system is coupled too densely" in text
        assert f"The estimated error of every speed is at most {estimate:.1e}." in text
        assert "`geartrain solve FILE --method exact`" in text
    assert "Solved in floats" not in str(GearTrain.declare(grid(100)).solve(method="floats"))

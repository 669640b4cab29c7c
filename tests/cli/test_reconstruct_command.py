"""`geartrain reconstruct`, as a user runs it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from answer_schemas import holds
from commands import call, ended

from geartrain import load
from geartrain.search.reconstruct import (
    dropped_facts,
    evidence_question,
    read_evidence,
)
from geartrain.search.reconstruct.reconstruction_problem import question_digest

NONE = """\
links: {a: {wheels: {p: 20}}}
inputs: {a: 1}
outputs: {sun: {expect: 1/3}}
reconstruct: {add: {wheels: 1, teeth: [10, 20]}}
"""


def answer(*words: object, code: int = 0) -> dict[str, Any]:
    """The data of a run, which have the shape of the schema."""
    done = call("reconstruct", *words, "--json")
    assert done.exit_code == code, done.output
    found: dict[str, Any] = json.loads(done.stdout)
    holds("reconstruct", found)
    return found


def test_counts() -> None:
    found = answer("isfahan-without-pivot", "--count")
    keys = ("added", "solutions", "multisets", "classes")
    rows = [(0, 0, 0, 0), (1, 0, 0, 0), (2, 32, 32, 16)]
    assert found["counts"] == [dict(zip(keys, row, strict=True)) for row in rows]
    assert (found["complete"], found["best"]) == (True, [])


def test_the_best_are_written_as_trains(tmp_path: Path) -> None:
    folder = tmp_path / "found"
    result = call("reconstruct", "moon-c-e", "--to", folder)
    assert result.exit_code == 0
    assert "24" in result.stdout
    files = sorted(folder.iterdir())
    assert [path.name for path in files] == ["family.json", "rank-0001.yaml", "rank-0002.yaml"]
    for path in files[1:]:
        assert load(path).solve()
        assert call("check", path).exit_code == 0
    before = [path.read_bytes() for path in files]
    assert ended("reconstruct", "moon-c-e", "--to", folder).returncode == 2
    assert call("reconstruct", "moon-c-e", "--to", folder, "--force").exit_code == 0
    assert [path.read_bytes() for path in files] == before


def test_as_many_are_listed_as_are_requested_for() -> None:
    assert len(answer("moon-c-e", "--best", "1")["best"]) == 1
    assert len(answer("moon-c-e", "--best", "1", "--all")["best"]) == 2
    assert "1 of 2 trains." in call("reconstruct", "moon-c-e", "--best", "1").stdout


def test_nothing_found_is_a_verdict_and_what_cannot_be_requested_is_none(tmp_path: Path) -> None:
    path = tmp_path / "evidence.yaml"
    path.write_text(NONE, encoding="utf-8")
    result = call("reconstruct", path)
    assert result.exit_code == 1
    assert "No train with at most 1 added wheel explains the evidence." in result.stdout
    assert call("reconstruct", path, "-k", "0", "--count").exit_code == 1
    assert ended("reconstruct", "planetary-24-18-60").returncode == 2
    assert ended("reconstruct", path, "--count", "--to", tmp_path / "out").returncode == 2
    path.write_text(NONE + "locks: [[a, a]]\n", encoding="utf-8")
    assert ended("reconstruct", path).returncode == 2


def test_a_train_of_which_an_arbor_is_lost(tmp_path: Path) -> None:
    """1 to 8: four pairs of counts, and two equal wheels of the arbor before."""
    folder = tmp_path / "found"
    found = answer("isfahan-astrolabe-1221", "--lost", "pivot", "--to", folder)
    assert found["original"] == [1, 8]
    assert [count["solutions"] for count in found["counts"]] == [0, 0, 8]
    assert "ranks 1 to 8" in " ".join(call("reconstruct", "isfahan-astrolabe-1221", "--lost", "pivot").stdout.split())
    assert len(list(folder.iterdir())) == 10
    again = answer(folder / "evidence.yaml")
    assert (again["counts"], again["best"], again["original"]) == (found["counts"], found["best"], None)
    assert ended("reconstruct", "isfahan-astrolabe-1221", "--lost", "year").returncode == 2
    assert ended("reconstruct", "back-train", "--lost", "m").returncode == 2


def test_the_family_tree_is_written_beside_the_trains(tmp_path: Path) -> None:
    call("reconstruct", "back-train", "--best", "1", "--to", tmp_path / "one")
    found = json.loads((tmp_path / "one" / "family.json").read_text(encoding="utf-8"))
    assert [branch["solutions"] for branch in found["family"]] == [4, 2, 1, 1, 2, 1, 1]
    assert [branch["parent"] for branch in found["family"]] == [None, 0, 1, 1, 0, 4, 4]
    assert found["family"][0]["meshes"] == ["b2 > l1"]
    assert found["family"][0]["weight"] == 1
    assert found["family"][2]["trains"] == [{"rank": 1, "weight": 0.25, "counts": {"m_new1": 27, "new_metonic1": 53}}]
    assert found["counts"][2]["solutions"] == 4
    assert len(found["question"]) == 64


def test_the_question_has_a_mark_of_its_own() -> None:
    requested = {
        question_digest(evidence_question(read_evidence("back-train"), wheels, idlers).problem)
        for wheels, idlers in ((1, False), (2, False), (2, True), (2, False))
    }
    assert len(requested) == 3


def test_what_is_told_beyond_counts() -> None:
    """`e4 meshes f1` leaves the train of 2006 alone, and a wheel of 53 is in two of the four."""
    found = answer("back-train")
    told = {(one["kind"], one["subject"]): one for one in found["marginals"]}
    yes = {answer["answer"]: answer for answer in told["mesh", "e4 > f1"]["answers"]}["yes"]
    assert yes == {"answer": "yes", "weight": 0.25, "solutions": 1}
    assert told["needed", "53"]["answers"][0]["solutions"] == 2
    assert told["mesh", "b2 > l1"]["answers"] == [{"answer": "yes", "weight": 1, "solutions": 4}]
    assert found["next_facts"][0]["bits"] == 1.5
    assert (found["assumptions"], found["missing"], found["listed"]) == ([], None, 4)
    (one,) = answer("metonic-l-m")["next_facts"]
    assert (one["bits"], len(one["same"])) == (1, 5)
    page = call("reconstruct", "metonic-l-m").stdout
    assert "All trains add a wheel of 53." in page
    assert "\nthe input: 100 %, 2 trains" in page
    assert "b2 > l1, l2 > m1, m2 > new_metonic1 (metonic): 50 %, rank 1 with" in page


def test_assumptions_are_dropped_where_that_is_requested() -> None:
    found = answer("back-train", "--assumptions", "--count")
    trains = {one["change"]: one["solutions"] for one in found["assumptions"]}
    assert trains["without the sense of any dial"] == [0, 0, 29]
    assert found["marginals"] == []
    assert "\nwithout the sense of any dial " in call("reconstruct", "back-train", "--assumptions").stdout


def test_why_nothing_fits(tmp_path: Path) -> None:
    """-1/3 is 20 > 60, beyond the bound of 40 teeth."""
    path = tmp_path / "evidence.yaml"
    path.write_text(NONE.replace("[10, 20]", "[10, 40]").replace("1/3", "-1/3"), encoding="utf-8")
    found = answer(path, code=1)
    assert found["missing"]["dials"] == [{"dial": "sun", "fewest": None, "refused": None}]
    assert [one["change"] for one in found["missing"]["uncertainties"]] == ["if added wheels may have 10 to 80 teeth"]
    page = call("reconstruct", path).stdout
    assert "not explained with at most 1 added wheel" in page
    assert "Changes of the evidence that would help" in page
    assert "Why no train explains" not in call("reconstruct", path, "--count").stdout


@pytest.mark.parametrize("requested", [("back-train", "--assumptions"), ("none",)])
def test_what_is_told_besides_may_be_stopped(
    requested: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(dropped_facts, "_count", stopped)
    path = tmp_path / "none"
    path.write_text(NONE, encoding="utf-8")
    file, *options = requested
    result = call("reconstruct", path if file == "none" else file, *options, "--json")
    assert result.exit_code == (1 if file == "none" else 0)
    assert " omitted" in result.stderr
    found = json.loads(result.stdout)
    assert (found["assumptions"], found["missing"]) == ([], None)
    assert len(found["best"]) == (0 if file == "none" else 4)


STOP_AFTER = 3


def test_assumptions_that_were_counted_before_an_interruption_stay(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    counted = dropped_facts._count
    requested: list[object] = []

    def some(task: Any) -> object:
        requested.append(task)
        if len(requested) == STOP_AFTER + 1:
            raise KeyboardInterrupt
        return counted(task)

    monkeypatch.chdir(tmp_path)
    whole = json.loads(call("reconstruct", "metonic-l-m", "--assumptions", "--count", "--json").stdout)["assumptions"]
    monkeypatch.setattr(dropped_facts, "_count", some)
    cut = call("reconstruct", "metonic-l-m", "--assumptions", "--count", "--json")
    assert json.loads(cut.stdout)["assumptions"] == whole[:STOP_AFTER]
    assert "the rest of the assumptions is omitted" in cut.stderr
    assert not list(tmp_path.iterdir())


def test_assumptions_are_the_same_with_workers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    requested = ("reconstruct", "metonic-l-m", "--assumptions", "--count", "--json")
    assert call(*requested, "--workers", "2").stdout == call(*requested).stdout


def test_a_page_shows_the_tree_and_the_trains_turning(tmp_path: Path) -> None:
    page = tmp_path / "found.html"
    result = call("reconstruct", "moon-c-e", "--page", page, "--animated", "1")
    assert result.exit_code == 0
    text = page.read_text(encoding="utf-8")
    assert "The family tree" in text
    assert "<iframe" in text
    assert text.count('data-scene="1"') == 2
    assert 'data-scene="2"' not in text
    assert ended("reconstruct", "moon-c-e", "--page", tmp_path / "x.md").returncode == 2
    assert ended("reconstruct", "moon-c-e", "--page", tmp_path / "y.html", "--count").returncode == 2
    path = tmp_path / "evidence.yaml"
    path.write_text(NONE, encoding="utf-8")
    assert call("reconstruct", path, "--page", tmp_path / "none.html").exit_code == 1
    assert "<iframe" not in (tmp_path / "none.html").read_text(encoding="utf-8")


def test_known_trains_are_ranked() -> None:
    known = answer("back-wheels-sure", "--count", "--rank", "freeth-2008", "--rank", "freeth-2006")["known"]
    first, second = known
    assert (first["wheels"], first["arbors"], first["broken"]) == ({"m3": 27, "n1": 53, "nO": 57}, 1, [])
    assert not first["telling"], "none of 21 is listed"
    assert (first["place"]["ranks"], first["place"]["trains"], first["place"]["dearer"]) == ([1, 21], 21, 1)
    assert (second["place"], [each["what"] for each in second["broken"]]) == (None, ["games turns at -1/76, not 1/4"])


def test_the_places_of_known_trains_are_told() -> None:
    told = call("reconstruct", "back-train", "--rank", "freeth-2008", "--rank", "price-1974", "-o", "-").stdout
    told = " ".join(told.split())
    assert "| freeth-2008 | 2: m3 27, n1 53 | 1 | 1-4 of 4 | 1-4 of 4 | 25 % | 1 |" in told
    assert "## Rules that price-1974 breaks" in told
    assert "| metonic is not shown | without the dial metonic |" in told


def test_the_report_is_written(tmp_path: Path) -> None:
    for suffix, begin in ((".md", "# Trains that explain metonic-l-m"), (".html", "<!doctype html>"), (".json", "{")):
        call("reconstruct", "metonic-l-m", "-o", tmp_path / f"found{suffix}")
        assert (tmp_path / f"found{suffix}").read_text("utf-8").startswith(begin)
    assert call("reconstruct", "metonic-l-m", "-o", "-").stdout.startswith("# Trains that explain metonic-l-m")
    same = tmp_path / "one.html"
    result = ended("reconstruct", "metonic-l-m", "-o", same, "--page", same)
    assert (result.returncode, "two results are written to the same file" in result.stderr) == (2, True)

"""The words of makers and historians beside the engineer's, in messages and in reports."""

from __future__ import annotations

import re

import shipped

from geartrain.report import collect_report, describe_train
from geartrain.train.trade_words import TRADE_WORDS, told_words, trade_words


def test_a_message_is_told_in_other_words_where_it_names_a_thing() -> None:
    assert told_words("no chain of turning pairs leads to it").startswith("words: turning pair: a pivot in its hole")
    assert [word.engineer for word in trade_words("Two links and their carriers")] == ["link", "carrier"]
    assert told_words("unknown key; did you mean another?") == ""


def test_names_that_a_reader_wrote_are_not_explained() -> None:
    assert told_words("'link' and `carrier: planet`") == ""
    assert told_words("a planetary gear") == ""


def test_no_more_than_four_are_told_at_once() -> None:
    assert told_words(" ".join(word.engineer for word in TRADE_WORDS)).count(";") == 3


def test_a_report_explains_what_it_names_and_no_more() -> None:
    for name in ("planetary-24-18-60", "zf-8hp70", "freeth-2008"):
        report = describe_train(collect_report(shipped.train(name)))
        *others, words, _sources = report.sections
        assert words.title == "Words"
        spoken = "\n".join(
            text
            for each in others
            for text in (each.title, *each.paragraphs, *(" ".join(t.header) for t in each.tables))
        ).lower()
        for engineer, *_ in words.tables[0].rows:
            assert re.search(rf"\b{engineer}", spoken), engineer
        assert {"link", "turning pair"} <= {row[0] for row in words.tables[0].rows}

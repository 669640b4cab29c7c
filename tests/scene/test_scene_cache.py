"""The cache of scenes that tests share: when it is read, when it is not, and that what it returns is the scene."""

from __future__ import annotations

from pathlib import Path

import pytest
import shipped

import geartrain
from geartrain.scene import Scene, build_scene, lay_out


@pytest.mark.parametrize("name", ["huygens-planetarium-1682", "lantern-mill"])
def test_a_scene_that_was_stored_equals_a_fresh_one(tmp_path: Path, name: str) -> None:
    made = []

    def make() -> Scene:
        made.append(name)
        return build_scene(geartrain.load(name))

    first = shipped.SceneCache(tmp_path, "digest").get(("built", name, None), make)
    stored = shipped.SceneCache(tmp_path, "digest").get(("built", name, None), make)
    assert made == [name]
    assert stored is not first
    assert stored == first == build_scene(geartrain.load(name)) == shipped.built(name)
    assert shipped.layout(name) == lay_out(geartrain.load(name))


def test_another_key_or_digest_and_a_damaged_file_miss_the_cache(tmp_path: Path) -> None:
    one = shipped.SceneCache(tmp_path, "one")
    assert [one.get(("a",), lambda made=made: made) for made in (1, 2)] == [1, 1]
    assert one.get(("b",), lambda: 3) == 3
    for path in one.folder.iterdir():
        path.write_bytes(path.read_bytes()[:-1])
    assert [one.get(("a",), lambda made=made: made) for made in (4, 5)] == [4, 4]
    other = shipped.SceneCache(tmp_path, "other")
    assert other.get(("a",), lambda: 6) == 6
    assert list(tmp_path.iterdir()) == [other.folder]
    assert len(list(other.folder.iterdir())) == 1, "no part of a file is left"


def test_the_digest_changes_with_a_byte_a_name_and_a_further_file_but_not_with_the_viewer(tmp_path: Path) -> None:
    def digest(place: str, text: str) -> str:
        path = tmp_path / place
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return shipped.digest_of(tmp_path)

    found = [digest("a.py", "x = 1"), digest("a.py", "x = 2"), digest("b.yaml", ""), digest("c/b.yaml", "")]
    assert len(set(found)) == 4
    assert shipped.digest_of(tmp_path) == digest("viewer/page.js", "x") == found[-1]

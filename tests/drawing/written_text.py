"""Texts of an SVG file, whose glyphs are outlines, so that their boxes are those of the visible text."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import combinations, pairwise

import numpy as np

SVG, LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
FONT = 100.0  # units per em in matplotlib's glyph outlines
_NUMBER = re.compile(r"-?\d*\.?\d+(?:e-?\d+)?")
_TURN = re.compile(r"(translate|rotate|scale)\(([^)]*)\)")
Matrix = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


@dataclass(frozen=True)
class WrittenText:
    """Line of text: corners of its box (4, 2) [pt], counter-clockwise from the lower left, and font size [pt]."""

    words: str
    corners: Matrix
    size: float

    @property
    def edges(self) -> Matrix:
        """Unit vectors (2, 2) along the line and perpendicular to it."""
        sides = self.corners[[1, 3]] - self.corners[0]
        return sides / np.maximum(np.hypot(*sides.T), 1e-12)[:, None]


@dataclass(frozen=True)
class WrittenPicture:
    """Texts of a picture, and its size [pt]."""

    width: float
    height: float
    texts: list[WrittenText] = field(default_factory=list)

    def overlaps(self, minimum: float = 0.4) -> list[tuple[str, str]]:
        """Return the pairs of texts whose boxes overlap by more than `minimum` points."""
        found = []
        low = np.array([text.corners.min(0) for text in self.texts]).reshape(-1, 2)
        high = np.array([text.corners.max(0) for text in self.texts]).reshape(-1, 2)
        for one, other in combinations(range(len(self.texts)), 2):
            near = (low[one] < high[other]).all() and (low[other] < high[one]).all()
            if near and depth(self.texts[one], self.texts[other]) > minimum:
                found.append((self.texts[one].words, self.texts[other].words))
        return found

    def clipped(self, margin: float = 0.0) -> list[str]:
        """Return the texts that extend beyond the edge of the page."""
        page = np.array([self.width, self.height])
        return [t.words for t in self.texts if (t.corners < margin).any() or (t.corners > page - margin).any()]

    def small(self, minimum: float) -> list[tuple[str, float]]:
        """Return the texts below a font size [pt]."""
        return [(text.words, text.size) for text in self.texts if text.size < minimum - 1e-6]


def depth(one: WrittenText, other: WrittenText) -> float:
    """Return the overlap of two boxes [pt]; 0 or negative if an axis separates them (separating axis theorem)."""
    minimum = np.inf
    for axis in (*one.edges, *other.edges):
        mine, its = one.corners @ axis, other.corners @ axis
        minimum = min(minimum, min(mine.max(), its.max()) - max(mine.min(), its.min()))
    return float(minimum)


def read_picture(data: bytes) -> WrittenPicture:
    """Return all texts of a picture that matplotlib wrote with glyphs as outlines."""
    root = ET.fromstring(data, ET.XMLParser(target=ET.TreeBuilder(insert_comments=True)))
    glyphs = {
        name: box(path.get("d", ""), path.get("transform", ""))
        for path in root.iter(f"{SVG}path")
        if (name := path.get("id"))
    }
    width, height = (float(root.get(side, "0pt").removesuffix("pt")) for side in ("width", "height"))
    return WrittenPicture(width, height, list(_texts(root, glyphs)))


@cache
def box(outline: str, scaled: str) -> Matrix | None:
    """Return the lower left and upper right corner (2, 3) of a glyph; None for a blank."""
    points = np.array(_NUMBER.findall(outline), dtype=float).reshape(-1, 2)
    if not len(points):
        return None
    return np.column_stack([np.array([points.min(0), points.max(0)]), [1.0, 1.0]]) @ transform(scaled).T


def _texts(root: ET.Element, glyphs: dict[str, Matrix | None]) -> Iterator[WrittenText]:
    """Yield each line of text: a comment with the text, and the following group of its glyphs."""
    for group in root.iter(f"{SVG}g"):
        for comment, drawn in pairwise(group):
            if comment.tag is ET.Comment and drawn.tag == f"{SVG}g":
                found = _line((comment.text or "").strip(), drawn, glyphs)
                if found is not None:
                    yield found


def _line(words: str, group: ET.Element, glyphs: dict[str, Matrix | None]) -> WrittenText | None:
    matrix = transform(group.get("transform", ""))
    boxes = []
    for use in group.iter(f"{SVG}use"):
        shape = glyphs.get(use.get(LINK, "").removeprefix("#"))
        if shape is None:
            continue
        boxes.append((shape @ transform(use.get("transform", "")).T)[:, :2])
    if not boxes:
        return None
    low, high = np.concatenate(boxes).min(0), np.concatenate(boxes).max(0)
    square = np.array([[low[0], low[1], 1], [high[0], low[1], 1], [high[0], high[1], 1], [low[0], high[1], 1]])
    return WrittenText(words, (square @ matrix.T)[:, :2], FONT * float(np.hypot(*matrix[:2, 0])))


def transform(text: str) -> Matrix:
    """Return the matrix of a sequence of translate, rotate and scale."""
    whole = np.eye(3)
    for kind, numbers in _TURN.findall(text):
        values = [float(each) for each in re.split(r"[\s,]+", numbers.strip())]
        step = np.eye(3)
        if kind == "translate":
            step[:2, 2] = (*values, 0.0)[:2]
        elif kind == "scale":
            step[0, 0], step[1, 1] = values[0], values[-1]
        else:
            turn = np.radians(values[0])
            step[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        whole = whole @ step
    return whole

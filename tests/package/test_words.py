"""Language of the package: docstrings are plain technical English, and texts avoid words of a private dialect."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import geartrain

PACKAGE = Path(geartrain.__file__).parent
FILES = sorted(path for path in PACKAGE.rglob("*.py") if "node_modules" not in path.parts)
FOLDERS = sorted({path.relative_to(PACKAGE).parts[0] for path in FILES})

# the standard word stands beside each: reports, is, maximum, minimum, requested, is not a, N
BANNED = re.compile(
    r"\b(told|tells|stands?|stood|greatest(?! common)|(?<!at )(?<!At )least(?! (squares|common))|asked"
    r"|(?<!here )(is|are) no|so many|mends?|spoilt|in place of|hands? in|goes for|what (stands|lies|goes))\b"
)
# a noun phrase does not begin so: the noun that is meant comes first
FRONTED = re.compile(r"(Of|What|How|Whether|Where|Which|Why|When|As|With|That|Those|Not|By|From|For|In|On|To|At) ")
SHORTEST = 4  # words of a function's docstring: a verb and what it returns


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def docstrings(path: Path) -> Iterator[tuple[ast.AST, str, str, int]]:
    """Each docstring: its node, kind (function, noun, test of truth), text, and line."""
    module = tree(path)
    inner = {
        id(inside)
        for node in ast.walk(module)
        if isinstance(node, ast.FunctionDef)
        for inside in ast.walk(node)
        if inside is not node
    }
    for node in ast.walk(module):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and (text := ast.get_docstring(node)):
            function = isinstance(node, ast.FunctionDef) and not _is_property(node)
            yield node, "function" if function else "noun", text, getattr(node, "lineno", 1)
        if isinstance(node, ast.Module | ast.ClassDef) and id(node) not in inner:
            for first, then in zip(node.body, node.body[1:], strict=False):
                if isinstance(first, ast.AnnAssign | ast.Assign) and _is_text(then):
                    assert isinstance(then, ast.Expr)
                    assert isinstance(then.value, ast.Constant)
                    yield then, "noun", str(then.value.value), then.lineno


def _is_text(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _is_property(node: ast.FunctionDef) -> bool:
    names = {part.id if isinstance(part, ast.Name) else getattr(part, "attr", "") for part in node.decorator_list}
    return not names.isdisjoint({"property", "cached_property", "computed_field", "abstractproperty"})


def files(folder: str) -> list[Path]:
    return [path for path in FILES if path.relative_to(PACKAGE).parts[0] == folder]


def first_sentence(text: str) -> str:
    return re.split(r"(?<=[.:;])\s", " ".join(text.split()), maxsplit=1)[0]


@pytest.mark.parametrize("folder", FOLDERS)
def test_the_docstring_of_a_function_begins_with_a_verb(folder: str) -> None:
    wrong = [
        f"{path.relative_to(PACKAGE)}:{line}: {first_sentence(text)}"
        for path in files(folder)
        for _, kind, text, line in docstrings(path)
        if kind == "function" and (text.split()[0].rstrip(",") not in VERBS or len(text.split()) < SHORTEST)
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("folder", FOLDERS)
def test_the_docstring_of_a_class_or_field_begins_with_its_noun(folder: str) -> None:
    wrong = [
        f"{path.relative_to(PACKAGE)}:{line}: {first_sentence(text)}"
        for path in files(folder)
        for _, kind, text, line in docstrings(path)
        if kind == "noun" and FRONTED.match(text)
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("folder", FOLDERS)
def test_texts_have_no_word_of_the_private_dialect(folder: str) -> None:
    wrong = []
    for path in files(folder):
        for line, text in texts(path):
            if found := BANNED.search(text):
                wrong.append(f"{path.relative_to(PACKAGE)}:{line}: {found.group()}: {' '.join(text.split())[:100]}")
    assert not wrong, "\n".join(wrong)


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Comments, docstrings, and strings of at least two words with their lines."""
    source = path.read_text(encoding="utf-8")
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value.strip():
            yield node.lineno, re.sub(r"`[^`]*`", "", node.value)


VERBS = frozenset(
    re.findall(
        r"\w+",
        """
    Accept Accumulate Add Adjust Advance Align Allocate Analyse Answer Append Apply Approximate Arrange Assemble Assert
    Assign Attach Average Balance Begin Bisect Bound Bracket Build Call Cancel Carry Check Choose Classify Clear
    Clip Close Collect Combine Compare Compile Complete Compose Compress Compute Connect Construct Continue Convert
    Copy Correct Count Create Cut Decide Declare Decode Decompose Decrease Define Delete Derive Describe Detect
    Determine Differentiate Discard Dispatch Display Distribute Divide Draw Drop Eliminate Embed Encode End Enforce
    Engrave Enter Enumerate Equate Escape Estimate Evaluate Exclude Exit Expand Explain Export Express Extend Extract
    Extrapolate Factor Fill Filter Find Finish Fit Fix Flatten Fold Follow Form Format Gather Generate Give Group
    Guess Handle Hash Highlight Hold Identify Import Include Increase Index Infer Initialize Insert Install
    Integrate Interpolate Interrupt Intersect Invert Isolate Iterate Join Judge Keep Label Lay Leave Lift Limit
    Linearize List Listen Load Locate Lock Log Look Lower Make Map Mark Match Maximise Maximize Measure Merge Mesh
    Minimise Minimize Mirror Modify Move Multiply Name Narrow Normalise Normalize Number Offset Omit Open Optimise
    Optimize Order Pack Pad Parse Partition Perform Permute Pick Place Plan Plot Pop Predict Prepare Print Process
    Produce Project Propagate Propose Prove Put Raise Rank Read Rearrange Rebuild Receive Recompute Record Reduce
    Refine Reflect Refuse Register Reject Release Remove Rename Render Repeat Replace Report Request Require
    Resample Reset Resolve Restart Restore Restrict Retry Return Reverse Rewrite Roll Rotate Round Run Sample Save
    Scale Scan Score Search Select Send Separate Serve Set Shift Shorten Show Shrink Sign Simplify Simulate Skip
    Solve Sort Split Start Step Stop Store Stream Submit Substitute Subtract Suggest Sum Summarise Summarize
    Superpose Support Suppress Swap Sweep Switch Tabulate Take Test Tile Trace Track Transform Translate Transpose
    Traverse Trim Try Turn Unfold Unite Unpack Update Use Validate Verify View Visit Wait Walk Warn Weigh Widen Wrap
    Write Yield
    """,
    )
)

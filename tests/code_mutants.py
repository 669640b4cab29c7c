"""Mutation testing of the package: changes one operator or constant and records which test fails.

    python tests/code_mutants.py --number 200 --seed 0 --out before.jsonl
    python tests/code_mutants.py --again before.jsonl --out after.jsonl

A mutant is the package with one operator or constant changed: the sign of a term, a product for a quotient, a
comparison at its boundary, `and` for `or`, an integer off by one. The changed places are drawn at random, from a seed,
in kinematics, dynamics, teeth and numerics. A mutant is killed if a test of the folder of the same name fails or does
not end; the files that import the mutated module run first, and with `--near` only these files. `--again` runs the
mutants of an earlier run with the present tests: those that were killed, or all of them with `--all`.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from random import Random

ROOT = Path(__file__).parent.parent
ROOMS = ("kinematics", "dynamics", "teeth", "numerics")
SWAPPED: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.And: ast.Or,
    ast.Or: ast.And,
}


@dataclass(frozen=True)
class Fault:
    """A part of a file, given by byte offsets, and the text that replaces it."""

    path: str
    line: int
    start: int
    end: int
    before: str
    after: str


def faults(path: Path) -> Iterator[Fault]:
    """Return all faults of a module in the order of its syntax tree."""
    source = path.read_bytes()
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    tree = ast.parse(source)
    passed = _not_computed(tree)
    for node in ast.walk(tree):
        if id(node) in passed or not isinstance(node, ast.expr):
            continue
        start = starts[node.lineno - 1] + node.col_offset
        end = starts[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
        before = ast.unparse(node)
        for other in _others(node):
            name = str(path.relative_to(ROOT))
            yield Fault(name, node.lineno, start, end, before, f"({ast.unparse(other)})")


def _not_computed(tree: ast.Module) -> set[int]:
    """Return the nodes of annotations, decorators and formatted text, which are not evaluated as arithmetic."""
    found: set[int] = set()
    for node in ast.walk(tree):
        parts: list[ast.AST | None] = []
        if isinstance(node, ast.FunctionDef):
            parts = [
                node.returns,
                *node.decorator_list,
                *(each.annotation for each in ast.walk(node.args) if isinstance(each, ast.arg)),
            ]
        elif isinstance(node, ast.AnnAssign):
            parts = [node.annotation]
        elif isinstance(node, ast.JoinedStr):
            parts = [node]
        for part in parts:
            if part is not None:
                found.update(id(each) for each in ast.walk(part))
    return found


def _others(node: ast.expr) -> Iterator[ast.expr]:
    """Yield the expressions that result from a single change at the top of an expression."""
    match node:
        case ast.BinOp(left, op, right) if type(op) in SWAPPED:
            yield ast.BinOp(left, SWAPPED[type(op)](), right)  # type: ignore[arg-type]
        case ast.Compare(left, [op], rest) if type(op) in SWAPPED:
            yield ast.Compare(left, [SWAPPED[type(op)]()], rest)  # type: ignore[list-item]
        case ast.BoolOp(op, values):
            yield ast.BoolOp(SWAPPED[type(op)](), values)  # type: ignore[arg-type]
        case ast.UnaryOp(ast.USub() | ast.Not(), operand):
            yield operand
        case ast.Constant(int(value)) if not isinstance(value, bool) and abs(value) < 100:
            yield ast.Constant(value + 1)


def drawn(number: int, seed: int, rooms: tuple[str, ...], near_only: bool) -> list[Fault]:
    """Return faults drawn at random, nearly the same number for each package."""
    random, found = Random(seed), []
    for at, room in enumerate(rooms):
        paths = sorted((ROOT / "geartrain" / room).rglob("*.py"))
        known = [each for path in paths if not near_only or near(ROOT, path.relative_to(ROOT)) for each in faults(path)]
        share = number // len(rooms) + (at < number % len(rooms))
        found += random.sample(known, min(share, len(known)))
    random.shuffle(found)
    return found


def near(root: Path, path: Path) -> list[Path]:
    """Return the test files, in the folder of the same name, that name a module of the package."""
    module = str(path.with_suffix("")).replace("/", ".").removesuffix(".__init__")
    every = sorted((root / "tests" / path.parts[1]).glob("test_*.py"))
    return [each for each in every if re.search(rf"\b{re.escape(module)}\b", each.read_text(encoding="utf-8"))]


class Trial:
    """A copy of the package and its tests in which faults are tried."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("geartrain", "tests", "trains", "docs", "README.md", "pyproject.toml", "CHANGELOG.md"):
            part = ROOT / name
            if part.is_dir():
                shutil.copytree(part, folder / name, ignore=shutil.ignore_patterns("__pycache__", "node_modules"))
            elif part.exists():
                shutil.copy(part, folder / name)

    def files(self, path: str, near_only: bool) -> list[list[str]]:
        """Return the test files for a module: those that name it, then the other files of the folder."""
        first = near(self.folder, Path(path))
        every = sorted((self.folder / "tests" / Path(path).parts[1]).glob("test_*.py"))
        others = [] if near_only else [each for each in every if each not in first]
        return [[str(each) for each in some] for some in (first, others) if some]

    def test(self, files: list[str], patience: float) -> tuple[str, float]:
        """Return the first test that fails, "timeout" or an empty string, and the run time [s]."""
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", "--tb=no", *files]
        environment = os.environ | {"PYTHONPATH": str(self.folder), "PYTHONDONTWRITEBYTECODE": "1"}
        begun = time.monotonic()
        try:
            done = subprocess.run(
                command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=patience, check=False
            )
        except subprocess.TimeoutExpired:
            return "timeout", patience
        taken = time.monotonic() - begun
        if done.returncode == 0:
            return "", taken
        failed = re.findall(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", done.stdout, re.M)
        return (failed[0] if failed else "collection"), taken

    def killer(self, fault: Fault, patience: float, near_only: bool) -> str:
        """Return the test that finds a fault, or an empty string."""
        path = self.folder / fault.path
        source = path.read_bytes()
        path.write_bytes(source[: fault.start] + fault.after.encode() + source[fault.end :])
        try:
            for files in self.files(fault.path, near_only):
                found, _ = self.test(files, patience)
                if found:
                    return found
        finally:
            path.write_bytes(source)
        return ""


def main() -> None:
    """Try the faults and write a line of JSON for each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--number", type=int, default=200, help="how many faults are drawn (200)")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the drawing (0)")
    parser.add_argument("--rooms", nargs="*", default=list(ROOMS), help="folders of the package")
    parser.add_argument("--near", action="store_true", help="only modules that tests import, and those tests (no)")
    parser.add_argument("--again", type=Path, help="try the faults that an earlier run wrote to this file")
    parser.add_argument("--all", action="store_true", help="with --again: also those that no test found then")
    parser.add_argument("--patience", type=float, default=1800, help="seconds after which tests are ended (1800)")
    parser.add_argument("--out", type=Path, required=True, help="file to write")
    requested = parser.parse_args()
    earlier: list[dict[str, str]] = []
    if requested.again:
        earlier = [json.loads(line) for line in requested.again.read_text(encoding="utf-8").splitlines()]
        chosen = [
            Fault(**{name: each[name] for name in Fault.__dataclass_fields__})  # type: ignore[arg-type]
            for each in earlier
            if requested.all or each["killer"]
        ]
    else:
        chosen = drawn(requested.number, requested.seed, tuple(requested.rooms), requested.near)
    killed = 0
    with tempfile.TemporaryDirectory() as folder, requested.out.open("w", encoding="utf-8") as out:
        trial = Trial(Path(folder))
        for at, fault in enumerate(chosen, 1):
            killer = trial.killer(fault, requested.patience, requested.near)
            killed += bool(killer)
            print(json.dumps({**asdict(fault), "killer": killer}), file=out, flush=True)
            print(f"{at}/{len(chosen)} {killed} killed: {fault.path}:{fault.line} {killer or 'LIVES'}", flush=True)
    print(f"{killed} of {len(chosen)} killed")


if __name__ == "__main__":
    main()

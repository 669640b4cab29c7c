"""Answers that must not change while the package is rebuilt: snapshots of what the command line says.

    python tests/answers.py write DIR
    python tests/answers.py compare DIR [--only WORD]

`write` runs the commands below on every shipped train, and those that stand in the pages, and keeps what each printed
and wrote. `compare` runs the same commands again, as DIR has them, and prints what differs; it ends with 1 if anything
does. A command is known here by its spelling only, and runs through `geartrain.cli:main`, so that all behind it may
move; `RENAMED` leads from an old spelling to a new one.

What is compared: exit codes; JSON key by key, fractions and integers exactly, floats to 12 significant digits; texts
line by line, or by a hash where they are long, their numbers to 12 digits; other files by a hash. Run times, versions,
dates and paths are masked. Of a page of HTML only the data in it are kept, not the program that shows them.

Left out, by rule: what is in `.pdf` and `.step`, of which only that they are made is compared; of shipped trains `.dxf`
and drawings but the plan; `bench`, which measures times; scripts of the pages that import from inside the package;
pipes behind a command of the pages; what the pages install or open. Trials, turns, samples and steps of searches are
few.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib
import json
import math
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

from places import train_files

ROOT = Path(__file__).resolve().parent.parent
RENAMED: dict[str, str] = {"geartrain errors": "geartrain montecarlo", "geartrain sweep": "geartrain posterior"}
"""Old spellings and new: of a verb where a command begins so ("geartrain mesh pin": "geartrain pin"), of an option
wherever it stands ("--free": "--in-doubt")."""

EACH = (
    *("solve {} --json", "solve {}", "solve {} --method floats --json", "check {}", "report {} --json", "report {}"),
    *(
        "inspect equations {}",
        "inspect equations {} --latex",
        "torques {} --json",
        "torques {}",
        "posterior {} --limit 20000 --json",
    ),
    *(f"inspect graph {{}} --as {form}" for form in ("labels", "edges", "matrix", "dot", "graphml", "json")),
    "view {} -o -",
    "draw {} -o -",
    "export {} --to out --as svg,stl,glb,graphml,dot,rexs,csv",
)
"""What is asked of every shipped train."""

RUNS = (
    "motion {} --turns 2 --samples 400 --links --estimates --spectrum --json",
    "motion {} --turns -1/3 --samples 50 -o -.csv",
    "montecarlo {} --trials 4 --json",
    "budget {} --turns 2 --samples 400 --trials 4 --json",
    'montecarlo {} --trials 4 --cutting pitch_deviation="0.1 deg" --cutting tip="0.3 %" --json',
)
"""What is asked of every state of every shipped train."""

SEARCHED = ("teeth train {} --sort total --best 5 --json", "teeth train {} -o -.csv")
"""What is asked of trains with wheels to be found."""

OTHERS = (
    *(
        "list",
        "periods",
        "inspect schema",
        "inspect schema --as markdown",
        "inspect schema --as answers",
        "sphere --survey --json",
    ),
    *(f"mesh 24 36 --friction 0.05 {more} --json" for more in ("", "--shaft-angle 90deg", "--driver 2")),
    *(f"mesh 12 45 --form {form} --friction 0.1 --json" for form in ("cycloidal", "lantern", "least_friction")),
    *(f"mesh 24 36 {form} --json" for form in ("--form uniform_stress", "--form uniform_temperature", "--compare")),
    *(f"mesh 48 96 --form triangular -p {by} --friction 0.2 --json" for by in ("clearance_factor=1.01", "window=0.3")),
    "mesh 36 70 --internal -p shift=0.696,0.226 --json",
    "mesh 20 31 --form triangular -p clearance_factor=1.012 --backwards --json",
    "mesh 48 96 --form triangular --vary clearance_factor=1.002:1.02:7 --vary friction=0:0.3:4 -o sweep.csv",
    "pin 9.6mm 1.1mm --friction 0.1 --json",
    *(
        f"teeth set 142 --kind {kind} --planets 3 --range 12:70 --best 5 --json"
        for kind in ("wolfrom", "3k-two-suns", "stepped-rings")
    ),
    "teeth ratio 235/19 --stages 2 --range 15:90 --tolerance 1e-5 --hunting --sort total --json",
    "teeth ratio 3.14159 --stages 2 --range 12:80 --internal 1 --reverted --tolerance 1e-4 -o -.csv",
    "compare price-1974 freeth-2006 freeth-2008 voulgaris-2022 pennestri-2002 --all --json",
    "compare planetary-24-18-60 planetary wolfrom-175 norton-planetary --all --json",
    "compare gosper-2005 clock-10000-years clock-10000-years-exact --all",
)
"""What is asked of no train, or of several."""

TELLING = (
    "solve",
    "report",
    "compare",
    "torques",
    "motion",
    "montecarlo",
    "budget",
    "sphere",
    "teeth",
    "posterior",
    "mesh",
)
"""Verbs with `--json`: where a page shows their text, their data are asked for too."""

LIMIT = 200
"""Seconds after which a command is taken to hang."""
LONGEST = 20_000
"""Letters up to which a text is kept as it is; longer ones, and all that is no text, by a hash."""
TRIALS = 128
"""Trials up to which shipped trains are cut in the pages."""
_SHIPPED = ("trains",)
"""Folders that the pages read."""
NOT_COMPARED = "a file whose content is not compared"
SHOWN = 10
"""Differing keys of an answer that are printed."""
DIGITS = 12

Json = Any
Answer = dict[str, Json]

_BLOCK = re.compile(r"((?:^<!-- (?:file|show): .*? -->\n)*)^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"<!-- file: (.*?) -->")
_INSIDE = re.compile(r"\bgeartrain\.\w+[\w.]* import|^import geartrain\.", re.MULTILINE)
_LONG_NUMBER = re.compile(r"-?\d+\.\d{9,}(?:[eE][-+]?\d+)?|-?\d+(?:\.\d+)?[eE][-+]?\d+")
_TRIALS = re.compile(r"(?<= --trials )\d+")
_SCRIPT = re.compile(r'<script type="application/json"[^>]*>(.*?)</script>', re.DOTALL)
_MASKS = (
    (re.compile(r"\bgeartrain \d+\.\d+\.\d+[\w.+-]*"), "geartrain VERSION"),
    (re.compile(r"\b20\d\d-\d\d-\d\d[T ]\d\d:\d\d(:\d\d)?[\d.+:Z]*"), "TIME"),
    (re.compile(r"\bin \d+(?:\.\d+)? s\b"), "in TIME"),
    (re.compile(r"\b246\d{4}\.\d{4,}"), "JULIAN"),
    (re.compile(r"\{[0-9A-F]{8}(?:-[0-9A-F]{4}){3}-[0-9A-F]{12}\}"), "{GUID}"),
    (re.compile(r"/\S*/geartrain-error-\w+\.txt"), "FAULT"),
)
_CLOCKS = {"seconds", "elapsed", "created", "date", "applicationVersion"}
"""Keys of JSON whose values are masked."""


class Group(NamedTuple):
    """Commands that share a folder.

    A page's steps are files to be written, lines for the shell, and commands, in order, and need each other; a train's
    commands do not.
    """

    name: str
    steps: list[dict[str, str]]
    together: bool
    train: bool = False


# ---------------------------------------------------------------------------------------------------------------------
# What is asked


def groups() -> Iterator[Group]:
    """All that is asked today."""
    for path in train_files():
        requested = (*EACH, *(SEARCHED if "search:" in path.read_text(encoding="utf-8") else ()))
        yield Group(
            path.stem, [_run(f"geartrain {each.format(path.stem)}") for each in requested], together=False, train=True
        )
    yield Group("others", [_run(f"geartrain {each}") for each in OTHERS], together=False)
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "docs" / "api" / "index.md"):
        steps = list(_steps(path))
        if any("run" in step for step in steps):
            yield Group(f"page-{'api' if path.parent.name == 'api' else path.stem}", steps, together=True)


def _run(command: str) -> dict[str, str]:
    return {"run": command}


def _steps(page: Path) -> Iterator[dict[str, str]]:
    """What a page writes and runs: blocks under `file`, consoles, and shell blocks that begin with `geartrain`."""
    texts: dict[str, str] = {}
    for marks, kind, body in _BLOCK.findall(page.read_text(encoding="utf-8")):
        for name in _FILE.findall(marks):
            texts[name] = body
            yield {"file": name, "text": body}
        if kind == "console":
            lines = [line[2:] for line in body.splitlines() if line.startswith("$ ")]
        else:
            lines = [line for line in body.splitlines() if kind == "sh" and line.startswith("geartrain ")]
        if page.stem != "commands":
            for line in lines:
                yield from _requested(line, texts)


def _requested(line: str, texts: dict[str, str]) -> Iterator[dict[str, str]]:
    """A line of a page: commands bare of pipes, with their data where there are any; other lines for the shell."""
    words = line.split()
    if words[0] == "bash":
        for each in texts[words[1]].splitlines():
            yield from _requested(each, texts)
    elif words[0] == "geartrain":
        command = re.split(r" (?:2?>|\|)", line)[0].strip()
        if words[2:] and not words[2].endswith(".yaml"):
            command = _TRIALS.sub(_fewer, command)
        if not any(each in command for each in ("--open", "completion")):
            yield _run(command)
            if words[1] in TELLING and not re.search(r" (--json|-o|--plot|--profile|--vary|--survey)\b", command):
                yield _run(f"{command} --json")
    elif words[0] == "python" and words[1] in texts and _INSIDE.search(texts[words[1]]):
        return
    elif words[0] != "echo":
        yield {"shell": line}


def _fewer(trials: re.Match[str]) -> str:
    return str(min(int(trials[0]), TRIALS))


def _states(train: str) -> list[str]:
    """The states of a train, as its answer tells them; one without a name is ""."""
    solved = answers(Group(train, [_run(f"geartrain solve {train} --json")], together=False), lambda command: True)
    return [shlex.quote(each["state"]) if each["state"] else "" for each in solved[0]["out"]["states"]]


# ---------------------------------------------------------------------------------------------------------------------
# Running


def respelled(command: str) -> list[str]:
    """The words of a command in today's spelling."""
    words = _searched(shlex.split(command))
    verbs = [old.split() for old in RENAMED if not old.startswith("-")]
    begins = [verb for verb in verbs if words[: len(verb)] == verb]
    if begins:
        verb = max(begins, key=len)
        words = RENAMED[" ".join(verb)].split() + words[len(verb) :]
    return [RENAMED.get(word, word) if word.startswith("-") else word for word in words]


def _searched(words: list[str]) -> list[str]:
    """What `geartrain teeth` was asked before it was said what is searched for, with the word for that."""
    if words[:2] != ["geartrain", "teeth"] or words[2] in ("ratio", "approximants", "train", "set", "orrery"):
        return words
    requested = words[2:]
    if "--kind" in requested:
        word = "set"
    elif "--approximants" in requested:
        word = "approximants"
    elif "=" in requested[0]:
        word = "orrery"
    else:
        word = (
            "train" if requested[0].endswith(".yaml") or list(ROOT.glob(f"trains/*/{requested[0]}.yaml")) else "ratio"
        )
    return [*words[:2], word, *(each for each in requested if each != "--approximants")]


def answers(group: Group, wanted: Callable[[str], bool]) -> list[Answer]:
    """What the commands of a group answer; those that are not wanted run only where others may need them."""
    found = []
    with tempfile.TemporaryDirectory(prefix="answers-") as made:
        for at, step in enumerate(group.steps):
            folder = Path(made) / ("page" if group.together else str(at))
            if not folder.exists():
                folder.mkdir()
                for name in _SHIPPED:
                    (folder / name).symlink_to(ROOT / name)
            if "file" in step:
                (folder / step["file"]).write_text(step["text"], encoding="utf-8")
                continue
            command = step.get("run") or step["shell"]
            if group.together or wanted(command):
                answer = _answer(command, folder, in_shell="shell" in step)
                if wanted(command):
                    found.append(answer)
    return found


def _answer(command: str, folder: Path, in_shell: bool) -> Answer:
    """Exit code, output, and every file that the command made or changed in its folder."""
    before = _files(folder)
    out, err = folder.parent / "out", folder.parent / "err"
    began = time.monotonic()
    with out.open("wb") as to_out, err.open("wb") as to_err:
        code = (_shell if in_shell else _forked)(command, folder, to_out.fileno(), to_err.fileno())
    took = time.monotonic() - began
    mask = _masking(folder)
    said: list[str] = [] if in_shell else mask(err.read_text(encoding="utf-8", errors="replace")).splitlines()
    answer = {"command": command, "exit": code, "out": _kept(out.read_bytes(), mask), "err": said, "files": {}}
    after = _files(folder)
    for name in sorted(after):
        if after[name] != before.get(name):
            answer["files"][name] = _kept((folder / name).read_bytes(), mask, Path(name).suffix)
    if not folder.name.startswith("page"):
        subprocess.run(["rm", "-rf", str(folder)], check=True)
    if os.environ.get("ANSWERS_TIMES"):
        print(f"{took:8.2f} s  {command}", file=sys.stderr)
    return answer


def _files(folder: Path) -> dict[str, tuple[int, int]]:
    every = (path for path in folder.rglob("*") if path.is_file() and path.relative_to(folder).parts[0] not in _SHIPPED)
    return {str(path.relative_to(folder)): (path.stat().st_size, path.stat().st_mtime_ns) for path in every}


def _environment() -> dict[str, str]:
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    known = {"COLUMNS": "100", "LINES": "40", "NO_COLOR": "1", "TERM": "dumb", "PYTHONPATH": str(ROOT), "PATH": path}
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    return os.environ | known | threads | {"SOURCE_DATE_EPOCH": "0", "PYTHONHASHSEED": "0", "PYTHONWARNINGS": "ignore"}


def _shell(command: str, folder: Path, out: int, err: int) -> int:
    given: dict[str, Any] = {"cwd": folder, "stdin": subprocess.DEVNULL, "stdout": out, "stderr": err}
    return subprocess.run(["bash", "-c", command], timeout=LIMIT, check=False, **given).returncode


def _forked(command: str, folder: Path, out: int, err: int) -> int:
    """Run one command of the package in a fork, which spares it the imports; the next forks find them made."""
    modules = folder.parent / "modules"
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        _become(respelled(command), folder, out, err, modules)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if code == -signal.SIGALRM:
        raise SystemExit(f"more than {LIMIT} s: {command}")
    if modules.exists():
        for name in modules.read_text(encoding="utf-8").split():
            if name not in sys.modules:
                with suppress(Exception):
                    importlib.import_module(name)
        modules.unlink()
    return code


def _become(words: Sequence[str], folder: Path, out: int, err: int, modules: Path) -> NoReturn:
    """Be the command; the modules it needed are told to those who fork next."""
    code = 70
    try:
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        os.dup2(out, 1)
        os.dup2(err, 2)
        os.chdir(folder)
        sys.stdin, sys.stdout, sys.stderr = (
            open(number, mode, encoding="utf-8", closefd=False)  # noqa: SIM115
            for number, mode in ((0, "r"), (1, "w"), (2, "w"))
        )
        sys.argv = list(words)
        signal.alarm(LIMIT)
        cli = importlib.import_module("geartrain.cli")
        try:
            cli.main()
            code = 0
        except SystemExit as ended:
            code = ended.code if isinstance(ended.code, int) else 0 if ended.code is None else 1
        signal.alarm(0)
        sys.stdout.flush()
        sys.stderr.flush()
        modules.write_text("\n".join(name for name in sys.modules if "." not in name or "geartrain" in name))
    except BaseException:  # such as a module that is not there
        traceback.print_exc()
        sys.stderr.flush()
    finally:
        os._exit(code)


# ---------------------------------------------------------------------------------------------------------------------
# What is kept


def _masking(folder: Path) -> Callable[[str], str]:
    def mask(text: str) -> str:
        for place, name in ((folder, "HERE"), (ROOT, "ROOT"), (Path(tempfile.gettempdir()), "TEMPORARY")):
            text = text.replace(f"{place}/", f"{name}/").replace(str(place), name)
        for pattern, put in _MASKS:
            text = pattern.sub(put, text)
        return text

    return mask


def _kept(raw: bytes, mask: Callable[[str], str], suffix: str = "") -> Json:
    """JSON as such, short texts by lines, the data of pages; a hash of all else."""
    if suffix in (".pdf", ".step"):
        return NOT_COMPARED
    try:
        text = mask(raw.decode("utf-8"))
    except UnicodeDecodeError:
        return _hash(raw)
    if text.startswith(("{", "[")):
        with suppress(ValueError):
            return _masked(json.loads(text))
    if text.lower().startswith("<!doctype html"):
        return {"data": [_masked(json.loads(each)) for each in _SCRIPT.findall(text)]}
    return text.splitlines() if len(text) <= LONGEST else _hash(_LONG_NUMBER.sub(_rounded, text).encode("utf-8"))


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.{DIGITS}g}"


def _hash(raw: bytes) -> str:
    return f"{len(raw)} bytes, sha256 {hashlib.sha256(raw).hexdigest()}"


def _masked(data: Json) -> Json:
    if isinstance(data, dict):
        return {
            key: "MASKED" if key in _CLOCKS and isinstance(value, int | float | str) else _masked(value)
            for key, value in data.items()
        }
    return [_masked(each) for each in data] if isinstance(data, list) else data


# ---------------------------------------------------------------------------------------------------------------------
# What differs


def differences(old: Json, new: Json, path: str = "") -> Iterator[tuple[str, Json, Json]]:
    """Where two answers differ: path, old value, new value."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in [*old, *(key for key in new if key not in old)]:
            yield from differences(old.get(key, _Absent), new.get(key, _Absent), f"{path}.{key}" if path else key)
    elif isinstance(old, list) and isinstance(new, list):
        for at in range(max(len(old), len(new))):
            before, after = (each[at] if at < len(each) else _Absent for each in (old, new))
            yield from differences(before, after, f"{path}[{at}]")
    elif not _same(old, new):
        yield path, old, new


class _Absent:
    """Stands for what is not there."""


def _same(old: Json, new: Json) -> bool:
    if isinstance(old, float) and isinstance(new, float):
        return old == new or math.isclose(old, new, rel_tol=10.0**-DIGITS) or (math.isnan(old) and math.isnan(new))
    if isinstance(old, str) and isinstance(new, str):
        return old == new or _LONG_NUMBER.sub(_rounded, old) == _LONG_NUMBER.sub(_rounded, new)
    return type(old) is type(new) and bool(old == new)


def _words(value: Json) -> str:
    text = "nothing" if value is _Absent else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 160 else f"{text[:150]} ... ({len(text)} letters)"


def _told(old: Answer, new: Answer) -> list[str]:
    """The lines on one command; none where nothing differs."""
    # a progress bar may leave an empty line behind, and says nothing by it
    found = list(differences(*({**each, "err": [line for line in each["err"] if line]} for each in (old, new))))
    if not found:
        return []
    spelled = shlex.join(respelled(old["command"])) if RENAMED else old["command"]
    lines = [f"{old['command']}" + (f"  (now {spelled})" if spelled != old["command"] else "")]
    for path, before, after in found[:SHOWN]:
        lines += [f"  {path}", f"    old {_words(before)}", f"    new {_words(after)}"]
    return [*lines, *([f"  and {len(found) - SHOWN} more"] if len(found) > SHOWN else [])]


# ---------------------------------------------------------------------------------------------------------------------
# The two verbs


def _write(group: Group, folder: Path) -> tuple[str, int]:
    if group.train:
        requested = (f"{each} --state {state}" if state else each for state in _states(group.name) for each in RUNS)
        group.steps.extend(_run(f"geartrain {each.format(group.name)}") for each in requested)
    found = answers(group, lambda command: True)
    kept = {"together": group.together, "steps": group.steps, "answers": found}
    text = json.dumps(kept, ensure_ascii=False, indent=0)
    (folder / f"{group.name}.json").write_text(text + "\n", encoding="utf-8")
    return group.name, len(found)


def _compare(path: Path, only: str) -> tuple[str, int, list[str]]:
    """How many commands of a snapshot were asked again, and what is to be told."""
    kept = json.loads(path.read_text(encoding="utf-8"))
    whole = only in path.stem

    def wanted(command: str) -> bool:
        return whole or only in command

    old = [each for each in kept["answers"] if wanted(each["command"])]
    if not old:
        return path.stem, 0, []
    new = answers(Group(path.stem, kept["steps"], kept["together"]), wanted)
    lines = [line for pair in zip(old, new, strict=True) for line in _told(*pair)]
    return path.stem, len(old), lines


def _first(large: Path | Group) -> int:
    """What takes long begins first."""
    name = large.name if isinstance(large, Group) else large.stem
    return -name.startswith("page") - 2 * name.startswith(("freeth-2021", "freeth-jones", "others", "page-cut"))


def main() -> int:
    """Write or compare; 1 if anything differs."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("verb", choices=("write", "compare"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", metavar="WORD", help="groups or commands that contain this")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes (2)")
    given = parser.parse_args()
    if os.environ.get("ANSWERS") != "1":  # threads and hashes are settled before Python starts
        os.execve(sys.executable, [sys.executable, *sys.argv], _environment() | {"ANSWERS": "1"})
    given.folder.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    with ProcessPoolExecutor(given.jobs) as pool:
        if given.verb == "write":
            tasks = sorted((each for each in groups() if given.only in each.name), key=_first)
            made = list(pool.map(_write, tasks, [given.folder] * len(tasks)))
            print(f"{sum(each[1] for each in made)} answers of {len(made)} groups, {time.monotonic() - began:.0f} s")
            return 0
        paths = sorted(given.folder.glob("*.json"), key=_first)
        requested = differing = 0
        for name, count, lines in pool.map(_compare, paths, [given.only] * len(paths)):
            requested += count
            differing += sum(not line.startswith(" ") for line in lines)
            if lines:
                print("\n".join((f"[{name}]", *lines, "")), flush=True)
    print(f"{differing} of {requested} answers differ, {time.monotonic() - began:.0f} s")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())

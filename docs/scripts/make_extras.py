"""What the extras weigh.

`python docs/scripts/make_extras.py --measure` installs each beside the core, and writes the page. Without
`--measure` the page is written from what was measured last, `docs/data/extras.json`.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RECORD, PAGE = ROOT / "docs/data/extras.json", ROOT / "docs/extras.md"
FOR = {
    "report": "`report`, `compare`, `torques` and others with `-o PAGE.html`",
    "plot": "`draw`, and `--plot` of every command",
    "dask": "`--workers`: long runs on a cluster",
    "dxf": "`export` of DXF",
    "proof": "`export`: the check that the exported parts turn",
    "step": "`export` of STEP",
    "tables": "Parquet and pandas: `montecarlo`, `posterior`, `.to_frame()`",
    "fast": "compiled runs of `motion` and `dynamics`",
    "fmu": "`export` of co-simulation units (FMU)",
    "sympy": "`train.formula(...)` as a sympy expression",
    "watch": "`watch`: pages that are updated when a file is saved",
    "all": "all of these except `step`",
}

PAGE_TEXT = """# Extras

Extras are groups of optional packages. Without extras, geartrain installs {count:.0f} packages ({size:.0f} MB). They
suffice for `solve`, `check`, `report`, `view`, `gearbox`, `inspect`, `torques`, `motion`, `dynamics`, `strength`,
`reconstruct`, `teeth`, `mesh`, for the `export` of SVG, STL and GLB files, and for the library. A command that needs
more packages prints the command that installs them, for example

```sh
pip install 'matplotlib>=3.8'
```

In a clone of the repository, `pip install -e '.[plot]'` installs the same packages.

| extra | for | `pip install` | packages added | MB |
|---|---|---|---:|---:|
{rows}

Sizes are those of the installed files before Python compiles them. Extras share packages, so several extras together
need less space than the sum of their sizes. `all` omits `step` because of its size. Three more extras are for
development: `dev` (810 MB including the core packages), `site` (builds this site) and `ci` (runs all tests). `python
docs/scripts/make_extras.py --measure` writes the table.
"""


def main() -> None:
    """Measure where that is asked, and write the page."""
    if "--measure" in sys.argv[1:]:
        RECORD.write_text(json.dumps(measured(), indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(page(json.loads(RECORD.read_text(encoding="utf-8"))), encoding="utf-8")
    print(f"wrote {PAGE.relative_to(ROOT)}")


def measured() -> dict[str, list[float]]:
    """Packages and megabytes of the core, and what each extra adds to them."""
    needs = extras()
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    with tempfile.TemporaryDirectory() as folder:
        core = Path(folder) / "core"
        subprocess.run([sys.executable, "-m", "venv", str(core)], check=True)
        pip = [str(core / "bin/python"), "-m", "pip", "install", "-q"]
        found = {"core": _added(pip, project["dependencies"], Path(folder))}
        subprocess.run([*pip, *project["dependencies"]], check=True)
        for extra in FOR:
            own = needs[extra]
            if extra == "all":
                inner = own[0].partition("[")[2].rstrip("]").split(",")
                own = [each for name in inner for each in needs[name]]
            found[extra] = _added(pip, own, Path(folder))
            print(extra, found[extra])
    return found


def extras() -> Mapping[str, list[str]]:
    """The packages of each extra, as pyproject.toml lists them."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needs: Mapping[str, list[str]] = project["optional-dependencies"]
    return needs


def _packages(extra: str, needs: list[str]) -> str:
    """What to give to pip; an extra made of others is installed from the sources."""
    return f"`-e '.[{extra}]'`" if needs[0].startswith("geartrain[") else " ".join(f"`'{need}'`" for need in needs)


def _added(pip: list[str], wanted: list[str], folder: Path) -> list[float]:
    """Packages that are not there yet, and what they fill [MB]."""
    plan, target = folder / "plan.json", Path(tempfile.mkdtemp(dir=folder))
    subprocess.run([*pip, "--dry-run", "--report", str(plan), *wanted], check=True)
    new = [each["metadata"] for each in json.loads(plan.read_text(encoding="utf-8"))["install"]]
    exact = [f"{each['name']}=={each['version']}" for each in new]
    if exact:
        subprocess.run([*pip, "--no-deps", "--target", str(target), *exact], check=True)
    size = sum(each.stat().st_size for each in target.rglob("*") if each.is_file())
    return [len(new), round(size / 1e6, 1)]


def page(record: Mapping[str, list[float]]) -> str:
    """The page."""
    count, size = record["core"]
    needs = extras()
    rows = [
        f"| `{extra}` | {what} | {_packages(extra, needs[extra])} | {record[extra][0]:.0f} | {record[extra][1]:.0f} |"
        for extra, what in FOR.items()
    ]
    return PAGE_TEXT.format(count=count, size=size, rows="\n".join(rows))


if __name__ == "__main__":
    main()

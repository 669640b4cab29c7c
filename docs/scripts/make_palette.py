"""Write the palette of the package for the viewer's sources: `python docs/scripts/make_palette.py`."""

from __future__ import annotations

from pathlib import Path

from geartrain.scene.palette import THEMES, Theme

SOURCES = Path(__file__).resolve().parents[2] / "geartrain" / "viewer" / "src"
MADE = "made by docs/scripts/make_palette.py from geartrain/scene/palette.py"


def main() -> None:
    """Write what the viewer and the diagrams have of it."""
    for name, text in files().items():
        (SOURCES / name).write_text(text, encoding="utf-8")
        print(f"wrote geartrain/viewer/src/{name}")


def files() -> dict[str, str]:
    """Name -> text."""
    light, dark = THEMES["light"], THEMES["dark"]
    series = ", ".join(f'"{colour}"' for colour in light.series)
    named = "".join(f'export const {name.upper()} = "{getattr(light, name)}";\n' for name in ("fault", "quiet", "line"))
    slate = f"[data-md-color-scheme='slate'] gear-diagram {{ {_of_diagrams(dark)} }}"
    return {
        "palette.css": f"/* {MADE} */\n:root {{ {light.css} }}\n:root[data-theme='dark'] {{ {dark.css} }}\n",
        "series.js": f"// {MADE}\nexport const SERIES = [{series}];\n{named}",
        "diagrams/light.css": f"/* {MADE} */\n:root {{ {_of_diagrams(light)} }}\n",
        "diagrams/dark.css": f"/* {MADE} */\n{slate}\n",
    }


def _of_diagrams(theme: Theme) -> str:
    """What a diagram paints with: `one` and `two` tell its two wheels apart."""
    named = {
        "ink": theme.ink,
        "quiet": theme.quiet,
        "paper": theme.desk,
        "line": theme.line,
        "accent": theme.accent,
        "one": theme.series[0],
        "two": theme.fault,
    }
    return " ".join(f"--gd-{name}: {colour};" for name, colour in named.items())


if __name__ == "__main__":
    main()

"""Write the palette of the package for the viewer's sources: `python docs/make_palette.py`."""

from __future__ import annotations

from pathlib import Path

from geartrain.scene.palette import THEMES

SOURCES = Path(__file__).resolve().parent.parent / "geartrain" / "viewer" / "src"
MADE = "made by docs/make_palette.py from geartrain/scene/palette.py"


def main() -> None:
    """Write palette.css and series.js."""
    for name, text in files().items():
        (SOURCES / name).write_text(text, encoding="utf-8")
        print(f"wrote geartrain/viewer/src/{name}")


def files() -> dict[str, str]:
    """Name -> text."""
    light, dark = (THEMES[name].css for name in ("light", "dark"))
    series = ", ".join(f'"{colour}"' for colour in THEMES["light"].series)
    return {
        "palette.css": f"/* {MADE} */\n:root {{ {light} }}\n:root[data-theme='dark'] {{ {dark} }}\n",
        "series.js": f"// {MADE}\nexport const SERIES = [{series}];\n",
    }


if __name__ == "__main__":
    main()

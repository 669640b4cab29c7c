"""Entry point of `python -m geartrain`."""

from __future__ import annotations

from geartrain.cli import main

if __name__ == "__main__":
    main("python -m geartrain")

"""Public names of a package that are imported on first access (PEP 562), so that no import loads all modules."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def public_names(
    package: str, modules: Mapping[str, str], subpackages: str = ""
) -> tuple[Callable[[str], Any], list[str]]:
    """Return the function `__getattr__` and the sorted names `__all__` of a package.

    modules       module in `package` -> names that it defines, separated by blanks; leading dots mean parent packages
    subpackages   names of packages in `package` that are its attributes without an import statement, separated by
                  blanks; they are not part of `__all__`
    """
    homes = {name: module for module, names in modules.items() for name in names.split()}

    def find(name: str) -> Any:
        if name in subpackages.split():
            return import_module(f".{name}", package)
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(f".{homes[name]}", package), name)

    return find, sorted(homes)

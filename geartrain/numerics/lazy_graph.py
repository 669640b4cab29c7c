"""Multigraph of networkx with attributes that are computed when they are first read.

An attribute of an edge may take longer to compute than the graph. It is stored as `Lazy(make)`, and networkx returns
the result of `make` whenever the attribute is read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import networkx as nx


class Lazy:
    """Value that is computed once, when it is first read; stored as an attribute of a graph."""

    __slots__ = ("_make", "_value")

    def __init__(self, make: Callable[[], Any]) -> None:
        self._make: Callable[[], Any] | None = make
        self._value: Any = None

    def __call__(self) -> Any:
        """Return the value, which is computed at the first call."""
        if self._make is not None:
            self._value = self._make()
            self._make = None  # releases the memory of the function
        return self._value


class LazyDict(dict[str, Any]):
    """Dictionary that computes its `Lazy` values when they are read; callers get only computed values.

    >>> requested = []
    >>> data = LazyDict(id="a", cost=Lazy(lambda: requested.append("cost") or 7))
    >>> list(data), requested
    (['id', 'cost'], [])
    >>> data["cost"], data.get("cost"), dict(data), requested
    (7, 7, {'id': 'a', 'cost': 7}, ['cost'])
    """

    __slots__ = ()

    def __getitem__(self, key: str) -> Any:
        value = super().__getitem__(key)
        return value() if isinstance(value, Lazy) else value

    def __iter__(self) -> Iterator[str]:
        # needed: dict(...) and update(...) copy stored values directly from a dictionary with the inherited __iter__
        return super().__iter__()

    def get(self, key: str, default: Any = None) -> Any:
        """Return the value of a key, or `default` if the key is missing."""
        if key not in self:
            return default
        return self[key]

    def pop(self, key: str, *default: Any) -> Any:
        """Remove a key and return its value."""
        value = super().pop(key, *default)
        return value() if isinstance(value, Lazy) else value

    def setdefault(self, key: str, default: Any = None) -> Any:
        """Return the value of a key, inserting `default` first if the key is missing."""
        super().setdefault(key, default)
        return self[key]

    def values(self) -> Any:
        """Return all values; lazy values are computed."""
        return self._made().values()

    def items(self) -> Any:
        """Return all items; lazy values are computed."""
        return self._made().items()

    def copy(self) -> dict[str, Any]:
        """Return a plain dictionary of all values; lazy values are computed."""
        return self._made()

    def __eq__(self, other: object) -> bool:
        return self._made() == other

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None

    def __or__(self, other: Mapping[str, Any]) -> Any:  # type: ignore[override]
        return self._made() | dict(other)

    def __repr__(self) -> str:
        stored = {key: super(LazyDict, self).__getitem__(key) for key in self}
        shown = (f"{key!r}: {'...' if isinstance(value, Lazy) else repr(value)}" for key, value in stored.items())
        return "{" + ", ".join(shown) + "}"

    def __reduce__(self) -> tuple[Any, ...]:
        return LazyDict, (self._made(),)

    def _made(self) -> dict[str, Any]:
        return {key: self[key] for key in self}


if TYPE_CHECKING:
    _MultiGraph = nx.MultiGraph[str]
else:
    _MultiGraph = nx.MultiGraph


class LazyGraph(_MultiGraph):
    """Multigraph whose nodes and edges store attributes in `LazyDict` objects."""

    node_attr_dict_factory = LazyDict
    edge_attr_dict_factory = LazyDict

    def __repr__(self) -> str:
        """Return networkx's summary line with name and numbers of nodes and edges."""
        return f"<{self}>"

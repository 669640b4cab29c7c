"""networkx multigraph with attributes that are computed on first access.

Computing an attribute of an edge may take longer than building the graph. Such an attribute is stored as `Lazy(make)`,
and networkx returns the result of `make` whenever it is read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from typing import TYPE_CHECKING, Any

import networkx as nx


class Lazy:
    """Attribute of a graph whose value is computed once, on first access."""

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


class LazyDict(MutableMapping[str, Any]):
    """Mapping that computes its `Lazy` values on access; callers only receive computed values.

    >>> requested = []
    >>> data = LazyDict(id="a", cost=Lazy(lambda: requested.append("cost") or 7))
    >>> list(data), requested
    (['id', 'cost'], [])
    >>> data["cost"], data.get("cost"), dict(data), requested
    (7, 7, {'id': 'a', 'cost': 7}, ['cost'])
    """

    __slots__ = ("_stored",)

    def __init__(self, *values: Any, **more: Any) -> None:
        self._stored: dict[str, Any] = dict(*values, **more)

    def __getitem__(self, key: str) -> Any:
        value = self._stored[key]
        return value() if isinstance(value, Lazy) else value

    def __setitem__(self, key: str, value: Any) -> None:
        self._stored[key] = value

    def __delitem__(self, key: str) -> None:
        del self._stored[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._stored)

    def __len__(self) -> int:
        return len(self._stored)

    def __contains__(self, key: object) -> bool:
        return key in self._stored

    def copy(self) -> dict[str, Any]:
        """Return a plain dictionary of all values, in which lazy values are computed."""
        return dict(self)

    def __or__(self, other: Mapping[str, Any]) -> dict[str, Any]:
        return dict(self) | dict(other)

    def __ror__(self, other: Mapping[str, Any]) -> dict[str, Any]:
        return dict(other) | dict(self)

    def __repr__(self) -> str:
        shown = (f"{key!r}: {'...' if isinstance(value, Lazy) else repr(value)}" for key, value in self._stored.items())
        return "{" + ", ".join(shown) + "}"

    def __reduce__(self) -> tuple[Any, ...]:
        return LazyDict, (dict(self),)


if TYPE_CHECKING:
    _MultiGraph = nx.MultiGraph[str]
else:
    _MultiGraph = nx.MultiGraph


class LazyGraph(_MultiGraph):
    """Multigraph whose nodes and edges store attributes in `LazyDict` objects."""

    node_attr_dict_factory = LazyDict
    edge_attr_dict_factory = LazyDict

    def __repr__(self) -> str:
        """Return networkx's summary line, with the name and the numbers of nodes and edges."""
        return f"<{self}>"

"""Trains in doubt: tooth counts that evidence leaves open, wheels cut by hand."""

from __future__ import annotations

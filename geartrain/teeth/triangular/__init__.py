"""Triangular teeth of antiquity: form and sizes, contact of one couple, the real path of all, its window, its law."""

from geartrain.teeth.triangular.triangular_form import Triangular

__all__ = ["Triangular"]

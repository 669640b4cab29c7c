"""Pins in slots and in followers: what a train declares of them, and their laws of motion."""

from geartrain.pins.couplings import Coupling, PinAndSlot, PinFollower, winding_number

__all__ = ["Coupling", "PinAndSlot", "PinFollower", "winding_number"]

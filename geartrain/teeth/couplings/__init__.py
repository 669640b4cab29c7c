"""Couplings of links other than gear pairs, one file a family; `teeth/coupling.py` has their base class and names.

pins                  pins in slots, pins in holes, links kept parallel
pin_transmission      transmission functions of a pin in a slot
series_transmission   transmission function of pins in slots, universal joints, elliptical and lobed wheels
pins                pins in slots, pins in holes, links kept parallel
pin_transmission    transmission functions of a pin in a slot
steps               Geneva drives, fingers and stars, ratchets, mutilated wheels
step_transmission   transmission functions of couplings that move by steps
"""

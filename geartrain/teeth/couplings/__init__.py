"""Couplings of links other than gear pairs, one file a family; `teeth/coupling.py` has their base class and names.

belt                  belts, chains and cables
ratio                 pairs and planetary sets of which only the ratio is known
pins                  pins in slots, pins in holes, links kept parallel
pin_transmission      transmission functions of a pin in a slot
series_transmission   transmission function of pins in slots, universal joints, elliptical and lobed wheels
table_transmission    transmission functions by tables and harmonics
steps                 Geneva drives, fingers and stars, ratchets, mutilated wheels
step_transmission     transmission functions of couplings that move by steps
"""

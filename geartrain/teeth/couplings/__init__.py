"""Couplings of links other than gear pairs, one file per family; `teeth/coupling.py` has their base class and names.

belt                  belts, chains and cables
laws                  universal joints, non-circular wheels, couplings by a table or harmonics
pins                  pins in slots, pins in holes, links kept parallel
pin_transmission      transmission functions of a pin in a slot
pitch_curves          centre distance and transmission function of non-circular wheels
ratio                 pairs and planetary sets of which only the ratio is known
series_transmission   transmission function of pins in slots, universal joints, elliptical and lobed wheels
step_transmission     transmission functions of couplings that move by steps
steps                 Geneva drives, fingers and stars, ratchets, mutilated wheels
table_transmission    transmission functions with a periodic deviation from uniform motion
"""

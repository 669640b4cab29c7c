"""Tables of Pennestri, Valentini and Petti (2002): gear pairs with their circuits, and turning pairs."""

from __future__ import annotations

# gear pair, its two links, the carrier, its two wheels
TABLES_1_TO_3 = """
    G1  2  3  1  Z2   Z3
    G2  2  4  1  Za2  Z4
    G3  4  10 1  Za4  Z10
    G4  4  6  1  Za4  Z6
    G5  4  15 1  Zb4  Z15
    G6  5  11 1  Za5  Za11
    G7  5  12 1  Za5  Z12
    G8  6  7  1  Za6  Z7
    G9  7  8  1  Za7  Z8
    G10 8  9  1  Z8   Z9
    G11 10 11 1  Za10 Z11
    G12 12 13 20 Za12 Z13
    G13 13 14 20 Z13  Z14
    G14 16 20 1  Z16  Za20
    G15 14 15 20 Za14 Za15
    G16 16 17 1  Za16 Z17
    G17 17 18 1  Za17 Z18
    G18 18 19 1  Za18 Z19
"""
TURNING_PAIRS = {
    (1, 2): 2, (1, 5): 5, (3, 5): 5, (4, 5): 5, (1, 6): 6, (1, 7): 7, (1, 8): 8, (1, 9): 9, (1, 10): 10, (1, 11): 11,
    (1, 15): 15, (12, 15): 15, (15, 20): 15, (13, 20): 13, (14, 20): 14, (1, 16): 16, (1, 17): 17, (1, 18): 18,
    (1, 19): 19,
}  # fmt: skip

"""Wheels, plates and pins as solid bodies for cutting, printing and viewing.

solid_assembly       `SolidModel`: all solids of a train, each with its body and position
built_scene          the scene of the viewer, with the parts as built
manufacturing_sizes  `ManufacturingSizes`: module, thickness, bore, backlash and process
solid_part           one solid and its position
triangle_solids      closed surfaces from flat shapes (ear clipping); approximate bevels, crown wheels and worms
wheel_blanks         the flat shape of every wheel, and openings between its spokes
bearing_plates       flat drawings to scale; curves round holes; discs that carry pins or slots
standing_pins        pins, slots and bars: in wheels, in plates, or separate parts
carrier_cages        brackets of arbors parallel to the plates, cages of carriers; the pendulum and the weight
dial_plates          plates of dials, their scales and feet
"""

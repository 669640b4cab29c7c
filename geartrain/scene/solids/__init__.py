"""Wheels, plates and pins as bodies with sizes: what a maker cuts, a printer prints and a viewer loads.

solid_assembly       `SolidModel`: all solids of a train, each with its body and place
built_scene          the scene of the viewer, with the parts that are built
manufacturing_sizes  `ManufacturingSizes`: module, thickness, bore, backlash and process of what is made

solid_part           one solid and its place
triangle_solids      closed surfaces of triangles from flat shapes
triangulation        triangles that fill a polygon
bevel_solids         bevels, crown wheels and worms, as likenesses
flat_drawing         a flat drawing to scale: what is cut, what is engraved

wheel_blanks         the flat shape of every wheel
wheel_arms           windows between the arms of a wheel
pin_couplings        pins and slots, cut into wheels or parts of their own
standing_pins        pins and bars that stand in plates and wheels
bearing_plates       curves round holes; discs of pins and slots
brackets             what bears arbors across the plates
carrier_cages        what bears axes that carriers carry at an angle to their own
dial_plates          plates of dials, their scales and feet
hangers              the pendulum and the weight
"""

"""Parts that connect the wheels of a mechanism: plates, pillars, arbors, pipes and studs, with their fits.

processes        laser, mill, printer, hand: kerf, minimum web, running and press fit, backlash
stack_discs      wheels and plates as discs in the stack; gaps between them; passages through plates
frame_stack      the upright axes, with their wheels as discs, eccentrics and pins in plates
arbor_columns    the members on one axis, from plate to plate; nesting of pipes; obstacles
carried_axes     plates and studs of carriers; discs of turning rings
eccentrics       eccentric discs on arbors for wheels carried close to the centre; circles of pins; cups of waves
turned_parts     arbors, pipes, studs, pillars as bodies of revolution
sleeves          spacers between wheels, collars and collets; the barrel of a weight
pillar_places    positions of pillars, and of posts that hold rings
frame_plates     outlines and holes of plates
frame_plan       positions of the plates, then all parts in order, with heights as built and plates of shafts
"""

"""Parts that make a mechanism of wheels: plates, pillars, arbors, pipes, studs, and how they fit into each other.

In: wheels as cut, where they stand, what the frame and the carriers bear. Out: a `FramePlan`: every part with the link
that it belongs to, wheels moved along their axes so that plates have room, the hole of every wheel, and what could not
be placed and why.

    processes        laser, mill, printer, hand: kerf, least web, running and press fit, play
    stack_discs      wheels and plates as discs in the stack; the gaps between them
    frame_stack      the axes that stand upright, with their wheels as discs, eccentrics and pins in plates
    arbor_columns    what stands on one axis, from plate to plate; which arbor runs inside which; what is in the way
    carried_axes     plates and studs of carriers; discs of turning rings
    eccentrics       discs on arbors on which wheels turn that are carried close to their middle
    flexible_cups    walls between thin wheels, which a wave bends, and their cups
    pin_circles      pins in plates: of rings, and of round holes
    plate_places     between which wheels the two plates stand
    turned_parts     arbors, pipes, studs, pillars as bodies of revolution
    sleeves          spacers between wheels, collars and collets
    barrels          the barrel on which the line of a weight is wound
    pillar_places    where pillars stand
    ring_posts       posts that hold rings
    plate_passages   openings in plates for wheels across them
    frame_plates     outlines and holes of plates
    frame_plan       all of these in order, with heights as built and plates of shafts
"""

"""Parts that make a mechanism of wheels: plates, pillars, arbors, pipes, studs, and how they fit into each other.

In: wheels as cut, where they stand, what the frame and the carriers bear. Out: a `FramePlan`: every part with the link
that it belongs to, wheels moved along their axes so that plates have room, the hole of every wheel, and what could not
be placed and why.

    processes         laser, mill, printer, hand: kerf, least web, running and press fit, play
    stack_discs       wheels and plates as discs in the stack; the gaps between them
    coaxial_order     which arbor runs inside which
    arbor_columns     what stands on one axis, from plate to plate; what is in its way
    carried_axes      plates and studs of carriers; discs of turning rings
    eccentrics        discs on arbors on which wheels turn that are carried close to their middle
    stack_eccentrics  which wheels of a stack these are, and which pins of round holes stand in plates
    flexible_cups     walls between thin wheels, which a wave bends, and their cups
    pin_circles       pins in plates: of rings, and of round holes
    plate_places      between which wheels the two plates stand
    stack_heights     room for plates; heights of all
    turned_parts      arbors, pipes, studs, pillars as bodies of revolution
    pillar_places     where pillars stand
    ring_posts        posts that hold rings
    frame_plates      outlines and holes of plates
    frame_plan        all of these in order
"""

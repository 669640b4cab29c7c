"""Train with inertia: input speed at which tooth contact is lost, and contact model for time integration
(docs/dynamics.md).

link_inertia        moments of inertia of links, declared or by Green's theorem from the outlines of wheels
inertial_contacts   torques that pairs carry due to inertia, loads and friction (d'Alembert's principle)
separation_rate     input speed at which teeth first separate (`find_separation`), and impacts of teeth
time_case           inertia, drag, restitution and drive of a train in one state
train_model         train as coordinates and contacts, with ideal pairs eliminated exactly
compliant_train     train model with stiffness and damping of teeth
contact_model       coordinates, contacts, bearings, stops and springs, and their arrays for the kernels
bearing_forces      forces of pairs on bearings whose friction grows with their load, as arrays
pair_tables         transmission functions as tables of polynomials between kinks
rubbing_arms        friction of teeth and pins as an addition to the lever arm of the driver
"""

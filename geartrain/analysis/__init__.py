"""The front door of the library: load a declaration, ask the `GearTrain`. Each part is made only when asked for."""

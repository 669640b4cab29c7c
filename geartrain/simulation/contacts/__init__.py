"""What is stepped: a train as coordinates and contacts, rigid or yielding (docs/dynamics.md, sections 4 and 6)."""

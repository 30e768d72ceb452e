"""Changes of drawings, as values: shapes, tools, symmetry, history, and the ways that robots take."""

"""The model of a scenario in the engine, and what its parts do in a step."""

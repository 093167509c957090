"""The solution viewer of the engine, with the machine as it looks."""

"""Steps, events, records and failures of a run in the engine."""

"""Studies: one question per file, each with scenarios, measures, figures and a main."""

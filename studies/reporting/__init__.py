"""How a study becomes a chapter of the report, and the chapters a page and a text."""

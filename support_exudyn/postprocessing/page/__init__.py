"""A page of HTML that needs nothing from elsewhere: its frame, style and script, and its pieces."""

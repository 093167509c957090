"""Speed against accuracy: scenes, tight references, ways to compute, and yardsticks that others set."""

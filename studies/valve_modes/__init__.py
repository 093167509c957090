"""What the paper's drive modes become if valves and a pump of limited flow make them."""

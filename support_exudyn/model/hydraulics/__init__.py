"""What a hydraulic leg can have besides its oil: valves, lines, stops, seals, a second stage; and the pump."""

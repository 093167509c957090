"""What do clearance in a pin and its size change?"""

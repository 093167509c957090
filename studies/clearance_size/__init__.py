"""What does the size of the clearance do to the rise?"""

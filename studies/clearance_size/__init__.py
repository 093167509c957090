"""clearance_size"""

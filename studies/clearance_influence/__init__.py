"""clearance_influence"""

"""redundant"""

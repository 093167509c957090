"""which_pin"""

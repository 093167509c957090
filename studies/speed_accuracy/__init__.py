"""What does an accuracy cost?"""

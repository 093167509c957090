"""What does the way of letting oil in do?"""

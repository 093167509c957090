"""Do the laws deliver what they promise?"""

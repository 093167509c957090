"""Which pin matters?"""

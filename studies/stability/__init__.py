"""Can it be told without a run whether a loaded pin shakes?"""

"""Can friction-induced vibration of a loaded pin be predicted without a simulation?"""

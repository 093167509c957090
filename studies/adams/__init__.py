"""A scenario written for ADAMS, so that owners of it can run the same model and compare."""

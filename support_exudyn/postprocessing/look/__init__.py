"""What machines look like: shapes that move with their bodies, and where they are at any record of a run.

Nothing here knows the engine, a file format or a picture; those take what stands here.
"""

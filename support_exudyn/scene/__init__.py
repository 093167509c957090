"""A scenario as arrays: bodies, points, joints, elements; their kernels; static equilibrium."""

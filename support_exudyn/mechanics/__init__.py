"""Motion, matrices, joint forces, oil and channels."""

"""Speed against accuracy: a scene, a tight reference, and programs that compute it."""

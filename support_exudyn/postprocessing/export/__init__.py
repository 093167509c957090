"""What is written for other programs: meshes, tables, and Exudyn's own solution file."""

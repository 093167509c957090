"""Normal contact laws, one per file."""

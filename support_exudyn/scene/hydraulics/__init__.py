"""Hydraulic legs with elements, as both formulations compute them: chambers that count their oil."""

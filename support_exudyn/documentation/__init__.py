"""The documentation as a site, see the README."""

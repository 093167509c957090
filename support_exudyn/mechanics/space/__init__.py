"""Machines in space: bodies with Euler parameters, bearings of finite length, columns with spherical ends."""

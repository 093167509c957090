"""Machines in space: rigid bodies with Euler parameters, bearings of finite length, columns with spherical ends."""

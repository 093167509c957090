"""Machines in space: bodies with Euler parameters, bearings of finite length, actuators with spherical ends."""

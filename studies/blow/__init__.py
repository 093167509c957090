"""What does a block do that falls on a set support?"""

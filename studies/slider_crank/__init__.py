"""slider_crank"""

"""speed_accuracy"""

"""drive_mode"""

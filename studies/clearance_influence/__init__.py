"""What does a clearance change, against ideal pins?"""

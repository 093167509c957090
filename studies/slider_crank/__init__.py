"""Does the program agree with others on the slider-crank?"""

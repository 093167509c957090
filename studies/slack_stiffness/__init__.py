"""How much of the linkage's stiffness is lost to slack in its pins?"""

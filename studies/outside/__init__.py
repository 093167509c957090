"""Published cases and foreign programs, beside this one."""

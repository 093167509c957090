"""The command line: each command is a function, and `app` reads its arguments as options."""

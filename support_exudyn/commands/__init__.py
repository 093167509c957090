"""The command line, one command a file; `parser` says what a command is."""

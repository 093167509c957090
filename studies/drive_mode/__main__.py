"""`python -m studies.drive_mode`."""

from studies.drive_mode.run import main

if __name__ == "__main__":
    raise SystemExit(main())

"""`python -m studies.clearance_size`."""

from studies.clearance_size.run import main

if __name__ == "__main__":
    raise SystemExit(main())

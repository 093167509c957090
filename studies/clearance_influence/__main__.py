"""`python -m studies.clearance_influence`."""

from studies.clearance_influence.run import main

if __name__ == "__main__":
    raise SystemExit(main())

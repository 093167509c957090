"""`python -m studies.extremes`."""

from studies.extremes.run import main

if __name__ == "__main__":
    raise SystemExit(main())

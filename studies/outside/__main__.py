"""`python -m studies.outside`."""

from studies.outside.run import main

if __name__ == "__main__":
    raise SystemExit(main())

"""`python -m studies.claims`."""

from studies.claims.run import main

if __name__ == "__main__":
    raise SystemExit(main())

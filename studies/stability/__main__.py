"""`python -m studies.stability`."""

from studies.stability.run import main

if __name__ == "__main__":
    raise SystemExit(main())

"""`python -m studies.slack_stiffness`."""

from studies.slack_stiffness.run import main

if __name__ == "__main__":
    raise SystemExit(main())
